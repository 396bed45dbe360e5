// A limit cycle needs a loop that is unstable at rest, (1b): |L(j 2 pi f) Phi'(0)| > 1 at the
// limit-cycle frequency. And a line appears where the loop's phase crosses 180 degrees a second
// time "with magnitude greater than one" (section 4): the same at each observed non-harmonic line.
// One-sided:
//
//   residual = max(0, 1 - |L Phi'(0)|) / std
//
// flame_slope: Phi'(0), data (the paper's table 3). std: standard deviation of the loop gain.
#include "estimation/residuals/acoustic_residual.h"

namespace howl {
namespace {

struct LoopGain {
  template <typename T>
  T Residual(const Acoustics<T>& acoustics) const {
    const double slope_times_w = std::abs(flame_slope) * kRadPerSPerHz * frequency_hz;
    const T shortfall =
        T(1.0) - T(slope_times_w) * Magnitude(AcousticResponse(acoustics, T(frequency_hz)));
    return shortfall > T(0.0) ? shortfall / T(std) : T(0.0);
  }

  double frequency_hz;
  double flame_slope;
  double std;
};

void AddLoopGain(ResidualAdder& problem, int i) {
  const Experiment& e = problem.ExperimentAt(i);
  if (!e.flame_slope) return;
  AddAcoustic(problem, i, LoopGain{e.frequency_hz, *e.flame_slope, problem.Spec().std});
}

void AddLoopGainAtLines(ResidualAdder& problem, int i) {
  const Experiment& e = problem.ExperimentAt(i);
  if (!e.flame_slope) return;
  for (const ObservedLine& line : e.lines) {
    AddAcoustic(problem, i, LoopGain{line.frequency_hz, *e.flame_slope, problem.Spec().std},
                FrequencySuffix(line.frequency_hz));
  }
}

}  // namespace

ResidualDefinition LimitCycleGainDefinition() {
  return {.text = "abs(L Phi'(0)) exceeds one (one-sided; reliable experiments)",
          .equation = "(1b)",
          .std = {"std", 0.05, "standard deviation of the loop gain"},
          .reliable_only = true,
          .add_to = &AddLoopGain};
}

ResidualDefinition SecondCrossingGainDefinition() {
  return {.text = "abs(L Phi'(0)) exceeds one at lines (one-sided; reliable; two modes)",
          .equation = "section 4, (1b)",
          .std = {"std", 0.05, "standard deviation of the loop gain"},
          .needs_two_modes = true,
          .reliable_only = true,
          .add_to = &AddLoopGainAtLines};
}

}  // namespace howl
