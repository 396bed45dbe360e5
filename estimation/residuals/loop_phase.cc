// The loop's phase is 180 degrees, modulo 360, at a frequency where the rig oscillates: at the
// limit-cycle frequency, (1a), and at an observed non-harmonic line, the second crossing of section
// 4.
//
//   residual = (arg L(j 2 pi f) - 180 degrees) / std,   wrapped to half a turn
//   std^2    = std_deg^2 + (360 tau std_f)^2
//
// std_deg: the configured standard deviation, degrees. std_f: that of the frequency, about which
// the delay turns the phase by 360 tau degrees per hertz; tau: equation (3). A cycle that noise
// drives has the phase of 180 degrees at its long-term frequency, from which that of a record
// differs by std_f. This concerns the loop and not G, because p = G q holds at whatever frequency
// the record had.
#include <cmath>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/residuals/acoustic_residual.h"

namespace howl {
namespace {

struct LoopPhase {
  template <typename T>
  T Residual(const LoopParameters<T>& loop) const {
    return T(kDegPerRad / std_deg) * LoopPhaseError(loop, T(frequency_hz));
  }

  double frequency_hz;
  double std_deg;
};

LoopPhase At(const ResidualAdder& problem, int i, double frequency_hz, double frequency_std_hz) {
  const double tau_s = DelayOf(problem.ExperimentAt(i));
  return {frequency_hz, std::hypot(problem.Spec().std, 360.0 * tau_s * frequency_std_hz)};
}

void AddLoopPhase(ResidualAdder& problem, int i) {
  const Experiment& e = problem.ExperimentAt(i);
  AddLoop(problem, i, At(problem, i, e.frequency_hz, e.frequency_std_hz.value_or(0.0)));
}

void AddLoopPhaseAtLines(ResidualAdder& problem, int i) {
  for (const ObservedLine& line : problem.ExperimentAt(i).lines) {
    AddLoop(problem, i, At(problem, i, line.frequency_hz, line.frequency_std_hz),
            FrequencySuffix(line.frequency_hz));
  }
}

}  // namespace

ResidualDefinition LimitCyclePhaseDefinition() {
  return {.text = "arg L is 180 degrees, L = s G e^(-tau s)",
          .equation = "(1a)",
          .std = {"std_deg", 1.0, "standard deviation in degrees"},
          .add_to = &AddLoopPhase};
}

ResidualDefinition SecondCrossingDefinition() {
  return {.text = "arg L is 180 degrees at each observed line (two modes)",
          .equation = "section 4",
          .std = {"std_deg", 5.0, "standard deviation in degrees"},
          .needs_two_modes = true,
          .add_to = &AddLoopPhaseAtLines};
}

}  // namespace howl
