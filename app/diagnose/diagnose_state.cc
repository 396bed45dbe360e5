#include "app/diagnose/diagnose_state.h"

namespace howl {
namespace {

// 2: every unit of work has a key of its own. 3: the hash is of the key as well.
constexpr int kFormat = 3;

}  // namespace

std::string DiagnoseStateHeader(const std::string& inputs_sha256) {
  return "howl.diagnosis.state/" + std::to_string(kFormat) + " " + ProgramIdentity() + " " +
         inputs_sha256;
}

std::optional<std::string> DiagnoseState::Recall(const std::string& key) {
  {
    const std::lock_guard<std::mutex> hold(lock_);
    asked_.Take(key);
  }
  const auto found = store_.found().find(key);
  if (found == store_.found().end()) return std::nullopt;
  return found->second;
}

void DiagnoseState::Keep(const std::string& key, const std::string& bytes) {
  {
    const std::lock_guard<std::mutex> hold(lock_);
    kept_.Take(key);
  }
  store_.Append(key, bytes);
}

}  // namespace howl
