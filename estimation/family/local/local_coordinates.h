// The coordinates u of a local search: for each experiment
//
//   ln xi,  (arg G - phase) / phase scale,  (|G| - gain) / gain scale,
//   loop phase error / loop phase scale,
//
// where a scale is the condition's tolerance, so that the condition is |u| <= 1. Where the
// experiments share the delay, (tau - tau_0) / tau scale stands once for all of them in the place
// of their loop phase errors, which follow from it. With two modes there is also ln omega of the
// experiment's own, or once for all experiments the shared ln M or ln (M / N).
//
// Every coordinate lives in an open box. What may be soft is not in the box: the conditions are
// rows (estimation/family/local/local_conditions.h). Units: Hz, rad, N and M as in
// model/loop/acoustics.h.
#ifndef HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_COORDINATES_H_
#define HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_COORDINATES_H_

#include <array>
#include <cstddef>
#include <vector>

#include "estimation/family/problem/problem.h"
#include "estimation/family/problem/targets.h"

namespace howl {

enum LocalCoordinate {
  kLocalXi,
  kLocalPhase,
  kLocalGain,
  kLocalDelay,   // the loop phase error, or the delay that the experiments share
  kLocalSecond,  // ln omega, or what the experiments share of the second mode
  kLocals
};

inline constexpr double kLocalMargin = 1e-9;   // of a condition: members pass in spite of rounding
inline constexpr double kLocalLeastXi = 1e-5;  // below, G's phase loses the digits of the test
inline constexpr double kLocalLargestXi = 20.0;  // stands for "no upper limit"

// One experiment's scales; a condition that is off has the scale of its unit, and is no row.
struct LocalScale {
  double phase_0, phase, gain_0, gain, loop_phase;
  std::array<Range, kLocals> box;
  bool has_phase, has_gain, has_loop_phase;
  double transfer_limit;  // infinite: none
};

struct LocalCoordinates {
  FamilyProblem problem;
  std::vector<ExperimentTarget> targets;
  bool two_modes = false;
  bool relative = false;       // the second mode is M / N, not M
  bool shared_second = false;  // all experiments have the same
  bool shared_tau = false;
  double tau_0_s = 0.0, tau_scale_s = 0.0;  // of a shared delay
  bool supported = true;                    // else nothing below is of use
  double ratio = 0.0;
  double ln_spread = 0.0;
  std::vector<LocalScale> scales;
  // Where an experiment's coordinates are among all of them; -1: a constant.
  std::vector<std::array<int, kLocals>> index;
  int size = 0;

  ParameterKind SecondKind() const { return relative ? ParameterKind::kMOverN : ParameterKind::kM; }
  // A coordinate of its own: no constant, and a shared one with the first experiment alone.
  bool IsOwn(std::size_t experiment, std::size_t k) const {
    const bool shared = (k == kLocalSecond && shared_second) || (k == kLocalDelay && shared_tau);
    return index[experiment][k] >= 0 && !(shared && experiment > 0);
  }
};

// Not `supported` where omega, xi or N is shared, or a condition or domain leaves no room.
LocalCoordinates MakeLocalCoordinates(const FamilyProblem& problem);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_COORDINATES_H_
