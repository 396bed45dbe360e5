// The flames that `howl export` writes, one for each experiment, and what they are relative to.
#ifndef HOWL_APP_INPUT_EXPORT_FLAME_H_
#define HOWL_APP_INPUT_EXPORT_FLAME_H_

#include <optional>
#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "app/input/problem_input.h"
#include "io/results/flame_export.h"

namespace howl {

struct ExportedFlame {
  std::string name;  // of the experiment
  double phi = 0.0;
  Flame<double> flame;  // slope zero: not known
  // "measured" by the record, stated by the "config", or "assumed": a hyperbolic tangent; "none"
  // where no slope is known.
  std::string origin;
  FlameScale scale;
  bool is_scaled = false;  // to the means that the user stated

  double SlopeAtRest() const { return FlameSlope(flame, 0.0); }
  bool HasSlope() const { return flame.slope < 0.0; }
  // Its gain at a velocity ratio is known: an assumed shape has no saturation in the units of q.
  bool Saturates() const { return HasSlope() && !(origin == "assumed" && is_scaled); }
};

// Of --mean-heat-release and --full-modulation, both or none. Throws UsageError.
std::optional<FlameScale> StatedScale(const Options& options);

// With nothing stated, a flame is relative to itself: to its saturation, and to the rate at which
// its tangent at rest reaches it.
std::vector<ExportedFlame> FlamesToExport(const Config& config, const ProblemInput& input,
                                          const std::optional<FlameScale>& stated);

}  // namespace howl

#endif  // HOWL_APP_INPUT_EXPORT_FLAME_H_
