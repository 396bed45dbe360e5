// A branch of limit cycles followed through a parameter lambda by pseudo-arclength (Keller 1977):
// harmonic balance r(u, lambda) = 0 together with the step along the tangent t,
//
//   t . ((u, lambda) - (u, lambda)_0) = ds
//
// so that the branch is followed around folds. The parameter is whatever `path` makes of it: tau,
// M / N, the flame's slope, or the equivalence ratio with everything that depends on it.
//
// Found on the way, and refined: where a cycle is born from rest or dies there (Hopf: amplitude
// zero), where two cycles meet (fold), and where stability changes without either (torus: a pair
// of multipliers leaves the unit circle, for instance as a second mode starts to grow on top of
// the cycle; period doubling at -1; branch point at +1).
#ifndef HOWL_MODEL_CYCLES_CONTINUATION_H_
#define HOWL_MODEL_CYCLES_CONTINUATION_H_

#include <complex>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "model/cycles/floquet.h"
#include "model/cycles/harmonic_balance.h"

namespace howl {

using ParameterPath = std::function<ClosedLoop(double)>;

struct ContinuationOptions {
  double parameter_min = 0.0;
  double parameter_max = 1.0;
  double first_step = 0.02;  // arc length; lengths are relative to the parameter's range
  double max_step = 0.05;
  double min_step = 1e-7;
  int max_points = 400;         // in each direction
  double min_amplitude = 1e-3;  // relative to saturation / |slope|: below it the branch ends (Hopf)
  bool stability = true;
  HarmonicBalanceOptions balance;
  FloquetOptions floquet;
};

struct BranchPoint {
  double parameter = 0.0;
  LimitCycle cycle;
  bool stable = false;  // when stability is asked for
  std::complex<double> leading_multiplier;
};

enum class BifurcationKind : std::uint8_t { kHopf, kFold, kTorus, kPeriodDoubling, kBranchPoint };

struct Bifurcation {
  BifurcationKind kind = BifurcationKind::kHopf;
  double parameter = 0.0;
  double frequency_hz = 0.0;
  double rate_amplitude = 0.0;
};

struct Branch {
  std::vector<BranchPoint> points;  // in order along the branch
  std::vector<Bifurcation> bifurcations;
};

// The branch through the cycle at `parameter`, in both directions, to the limits of the parameter.
Branch ContinueCycle(const ParameterPath& path, double parameter, const LimitCycle& cycle,
                     const ContinuationOptions& options);

// Intervals of the parameter in which the branch has a stable cycle, merged, in order.
struct ParameterInterval {
  double lo = 0.0;
  double hi = 0.0;
};
std::vector<ParameterInterval> StableIntervals(const Branch& branch);
std::vector<ParameterInterval> Intersect(const std::vector<ParameterInterval>& a,
                                         const std::vector<ParameterInterval>& b);

}  // namespace howl

#endif  // HOWL_MODEL_CYCLES_CONTINUATION_H_
