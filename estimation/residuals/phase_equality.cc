// arg G(j 2 pi f) = Delta at the limit-cycle frequency f: second line of (5a), or of (5c).
//
//   residual = arg(G e^(-j Delta)) / std
//
// Delta: measured phase from q to p, degrees; std_deg: its standard deviation. G is rotated back by
// Delta before its angle is taken, so that the residual is wrapped.
#include "estimation/residuals/acoustic_residual.h"

namespace howl {
namespace {

struct PhaseEquality {
  template <typename T>
  T Residual(const Acoustics<T>& acoustics) const {
    const Complex<double> back = UnitPhasor(-phase_deg * kRadPerDeg);
    return T(kDegPerRad / std_deg) *
           Angle(AcousticResponse(acoustics, T(frequency_hz)) * Complex<T>{T(back.re), T(back.im)});
  }

  double frequency_hz;
  double phase_deg;
  double std_deg;
};

void AddPhaseEquality(ResidualAdder& problem, int i) {
  const Experiment& e = problem.ExperimentAt(i);
  AddAcoustic(
      problem, i,
      PhaseEquality{e.frequency_hz, e.phase_deg, e.phase_std_deg.value_or(problem.Spec().std)});
}

}  // namespace

ResidualDefinition PhaseEqualityDefinition() {
  return {.text = "arg G is the measured phase",
          .equation = "(5a), (5c)",
          .std = {"std_deg", 0.5, "standard deviation in degrees"},
          .has_form = true,
          .add_to = &AddPhaseEquality};
}

}  // namespace howl
