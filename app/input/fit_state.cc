#include "app/input/fit_state.h"

#include "app/jobs/config_inputs.h"
#include "app/process/interruption.h"

namespace howl {
namespace {

constexpr int kFormat = 1;
constexpr const char* kComplete = "complete";

std::string Header(const Config& config, const Options& options, const std::string& file,
                   const std::string& choices) {
  return "howl." + file + "/" + std::to_string(kFormat) + " " + ProgramIdentity() + " " +
         std::to_string(options.seed) + " " + ConfigInputsSha256(config) +
         (choices.empty() ? "" : " " + choices);
}

}  // namespace

FitState::FitState(const Config& config, const Options& options, const std::string& file,
                   const std::string& choices)
    : path_(options.out / file), header_(Header(config, options, file, choices)) {
  WatchForInterruption();
  store_ = std::make_unique<UnitStore>(path_, header_);
}

bool FitState::IsComplete() const { return store_->found().contains(kComplete); }

void FitState::BeginAnewIfComplete() {
  if (!IsComplete()) return;
  store_->Forget();
  store_ = std::make_unique<UnitStore>(path_, header_);
}

void FitState::SayWhereItStands() const {
  if (!IsComplete()) SayWhereItGoesOn(*store_, path_);
}

std::optional<std::string> FitState::Recall(const std::string& key) {
  if (IsInterrupted()) {
    throw Interrupted("interrupted: nothing written; the same command goes on from " +
                      path_.string());
  }
  const auto found = store_->found().find(key);
  if (found == store_->found().end()) return std::nullopt;
  return found->second;
}

void FitState::Keep(const std::string& key, const std::string& bytes) {
  store_->Append(key, bytes);
}

void FitState::Complete() {
  if (!IsComplete()) store_->Append(kComplete, "");
}

}  // namespace howl
