#include "app/input/fit_state.h"

#include "app/jobs/config_inputs.h"
#include "app/process/interruption.h"

namespace howl {
namespace {

constexpr int kFormat = 1;
constexpr const char* kComplete = "complete";

std::string Header(const Config& config, const Options& options) {
  return "howl.fit.state/" + std::to_string(kFormat) + " " + ProgramIdentity() + " " +
         std::to_string(options.seed) + " " + ConfigInputsSha256(config);
}

}  // namespace

FitState::FitState(const Config& config, const Options& options, bool anew)
    : path_(options.out / "fit.state") {
  WatchForInterruption();
  const std::string header = Header(config, options);
  store_ = std::make_unique<UnitStore>(path_, header);
  const bool complete = store_->found().contains(kComplete);
  if (anew && complete) {
    store_->Forget();
    store_ = std::make_unique<UnitStore>(path_, header);
  }
  if (!options.quiet && !complete) SayWhereItGoesOn(*store_, path_);
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
  if (!store_->found().contains(kComplete)) store_->Append(kComplete, "");
}

}  // namespace howl
