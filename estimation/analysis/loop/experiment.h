// One operating point and what its record showed: a row of the paper's tables 1 to 3, and the
// non-harmonic lines of its section 4. Published tables and analysed records both end here.
#ifndef HOWL_ESTIMATION_ANALYSIS_LOOP_EXPERIMENT_H_
#define HOWL_ESTIMATION_ANALYSIS_LOOP_EXPERIMENT_H_

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "estimation/analysis/transfer/transfer_ellipsoid.h"
#include "estimation/transfer_point.h"

namespace howl {

// A non-harmonic line of the pressure spectrum at which the loop is taken to close a second time.
struct ObservedLine {
  double frequency_hz = 0.0;
  double frequency_std_hz = 0.0;
};

struct Experiment {
  std::string name;
  double phi = 0.0;           // operating parameter: equivalence ratio, or what the config names
  double frequency_hz = 0.0;  // limit-cycle frequency
  double phase_deg = 0.0;     // from q to p at frequency_hz: negative when p lags q
  double gain = 0.0;          // |p| / |q| at frequency_hz
  std::optional<double> flame_slope;  // Phi'(0), not positive

  // Whole periods that the delay exceeds the shortest one of (3).
  int delay_periods = 0;

  // Standard deviations where the data give them; absent ones take the residual's default.
  std::optional<double> frequency_std_hz;
  std::optional<double> phase_std_deg;
  std::optional<double> gain_std;  // in units of gain
  std::optional<double> flame_slope_std;

  // Coherent q-to-p transfer of a record, thinned to independent points; empty for a published row.
  std::vector<TransferPoint> transfer;
  // The ellipsoid to which that transfer confines the acoustics, where it determines any parameter.
  std::optional<TransferEllipsoid> transfer_ellipsoid;

  bool reliable = true;
  std::vector<ObservedLine> lines;

  // The range of |Phi'(0)| that the data allow: as many standard deviations about the estimate as
  // the family's test allows a transfer. A published slope without an error is taken as exact.
  double SteepestSlope() const { return std::abs(*flame_slope) + SlopeDoubt(); }
  double FlattestSlope() const { return std::max(std::abs(*flame_slope) - SlopeDoubt(), 0.0); }

 private:
  static constexpr double kSlopeStds = 4.0;
  double SlopeDoubt() const { return kSlopeStds * flame_slope_std.value_or(0.0); }
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_LOOP_EXPERIMENT_H_
