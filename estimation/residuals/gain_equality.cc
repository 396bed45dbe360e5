// |G(j 2 pi f)| = A_p / A_q at the limit-cycle frequency f: first line of (5a), or of (5c).
//
//   residual = log(|G| / gain) / std_relative
//
// gain: measured, in units of p per unit of q. std_relative: standard deviation of the measured
// gain over the gain. The logarithm makes the residual linear in log N.
#include "estimation/residuals/acoustic_residual.h"

namespace howl {
namespace {

struct GainEquality {
  template <typename T>
  T Residual(const Acoustics<T>& acoustics) const {
    using std::log;
    const T squared = SquaredMagnitude(AcousticResponse(acoustics, T(frequency_hz)));
    return T(0.5 / std_relative) * log(squared / T(gain * gain));
  }

  double frequency_hz;
  double gain;
  double std_relative;
};

void AddGainEquality(ResidualAdder& problem, int i) {
  const Experiment& e = problem.ExperimentAt(i);
  const double std_relative = e.gain_std ? *e.gain_std / e.gain : problem.Spec().std;
  AddAcoustic(problem, i, GainEquality{e.frequency_hz, e.gain, std_relative});
}

}  // namespace

ResidualDefinition GainEqualityDefinition() {
  return {.text = "abs(G) is the measured gain at the limit cycle",
          .equation = "(5a), (5c)",
          .std = {"std_relative", 0.01, "relative standard deviation of gain"},
          .has_form = true,
          .add_to = &AddGainEquality};
}

}  // namespace howl
