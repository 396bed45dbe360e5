// The fits that a diagnosis has finished, in DIR/diagnosis.state (app/jobs/unit_store.h), so that a
// run that was interrupted, or killed, goes on where it stopped. The header names the format, the
// build of the program (another may fit otherwise), and the inputs.
#ifndef HOWL_APP_DIAGNOSE_DIAGNOSE_STATE_H_
#define HOWL_APP_DIAGNOSE_DIAGNOSE_STATE_H_

#include <filesystem>
#include <mutex>
#include <string>

#include "app/jobs/unit_store.h"
#include "diagnosis/fit/fit_memory.h"

namespace howl {

// `inputs_sha256`: of all that the fits depend on (InputBytes).
std::string DiagnoseStateHeader(const std::string& inputs_sha256);

class DiagnoseState final : public FitUnits {
 public:
  explicit DiagnoseState(UnitStore& store) : store_(store) {}

  std::optional<std::string> Recall(const std::string& key) override;
  void Keep(const std::string& key, const std::string& bytes) override;

 private:
  UnitStore& store_;
  std::mutex lock_;
  UniqueKeys asked_{"asked for"};
  UniqueKeys kept_{"kept"};
};

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_DIAGNOSE_STATE_H_
