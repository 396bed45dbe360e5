// The fits of points that a fit of records has finished, in DIR/fit.state, or those of a diagnosis,
// in DIR/diagnosis.state (app/jobs/unit_store.h): work that was interrupted, or killed, goes on
// where it stopped, and what comes after a fit (simulate, predict) takes its loops from there. The
// header names the format, the build of the program (another may fit otherwise), the seed, and the
// inputs.
#ifndef HOWL_APP_INPUT_FIT_STATE_H_
#define HOWL_APP_INPUT_FIT_STATE_H_

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/command_line/options.h"
#include "app/jobs/unit_store.h"
#include "estimation/joint_records/fit_units.h"
#include "io/config/config.h"

namespace howl {

class FitState final : public FitUnits {
 public:
  // `choices`: what else than config, records and random seed the fits depend on; no line's end.
  FitState(const Config& config, const Options& options, const std::string& file,
           const std::string& choices = "");

  // What a fit that came to its end has left is removed, so that howl fit fits.
  void BeginAnewIfComplete();
  // On standard error, where there is work to go on from.
  void SayWhereItStands() const;

  // Throws Interrupted where the user has asked for a stop: what is finished is kept.
  std::optional<std::string> Recall(const std::string& key) override;
  void Keep(const std::string& key, const std::string& bytes) override;
  // The whole fit is there.
  void Complete();
  void Forget() { store_->Forget(); }

 private:
  bool IsComplete() const;

  std::filesystem::path path_;
  std::string header_;
  std::unique_ptr<UnitStore> store_;
};

}  // namespace howl

#endif  // HOWL_APP_INPUT_FIT_STATE_H_
