// At the limit cycle the second mode can be neglected, (5b). One-sided:
//
//   residual = max(0, |M U_r(j 2 pi f)| / |N U_1(j 2 pi f)| - share_max) / std
//
// share_max: the share up to which the second mode hardly matters; std: standard deviation of the
// share.
#include "estimation/residuals/acoustic_residual.h"
#include "model/loop/second_mode.h"

namespace howl {
namespace {

struct SecondModeMinor {
  template <typename T>
  T Residual(const Acoustics<T>& acoustics) const {
    const T excess = SecondModeShare(acoustics, T(frequency_hz)) - T(share_max);
    return excess > T(0.0) ? excess / T(std) : T(0.0);
  }

  double frequency_hz;
  double share_max;
  double std;
};

void AddSecondModeMinor(ResidualAdder& problem, int i) {
  AddAcoustic(problem, i,
              SecondModeMinor{problem.ExperimentAt(i).frequency_hz, problem.Spec().center,
                              problem.Spec().std});
}

}  // namespace

ResidualDefinition SecondModeMinorDefinition() {
  return {.text = "abs(M U_r / N U_1) is small at the limit cycle (one-sided, two modes)",
          .equation = "(5b)",
          .std = {"std", 0.01, "standard deviation of the share"},
          .center = {"share_max", kSecondModeShareMax,
                     "up to which the second mode hardly matters at the limit cycle"},
          .needs_two_modes = true,
          .add_to = &AddSecondModeMinor};
}

}  // namespace howl
