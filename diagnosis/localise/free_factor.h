// The responses of the free factor and of the free section of free_slack.h.
#ifndef HOWL_DIAGNOSIS_LOCALISE_FREE_FACTOR_H_
#define HOWL_DIAGNOSIS_LOCALISE_FREE_FACTOR_H_

#include <cmath>
#include <string>
#include <vector>

#include "model/effects/effect.h"

namespace howl {

inline std::vector<EffectParameter> FactorParameters(int count) {
  std::vector<EffectParameter> out;
  for (int j = 1; j <= count; ++j) {
    out.push_back({"c" + std::to_string(j), "", 0.0, -6.0, 6.0, {0.0}});
  }
  return out;
}

// causal: coefficients of j = 1, 2, ...; anticausal: of j = -1, -2, ...
inline Response FreeFactor(double frequency_hz, double centre_hz, EffectValues causal,
                           EffectValues anticausal) {
  const Response step =
      Response(-centre_hz, frequency_hz) / Response(centre_hz, frequency_hz);  // of modulus one
  Response sum = 0.0;
  Response power = 1.0;
  for (const double c : causal) sum += c * (power *= step);
  power = 1.0;
  for (const double c : anticausal) sum += c * (power *= std::conj(step));
  return std::exp(sum);
}

// (1 + b_1 u + b_2 u^2) / (1 + 2 zeta u + u^2), u = s / (2 pi f_0): low-passes, resonances,
// notches.
inline std::vector<EffectParameter> SectionParameters(double cycle_hz) {
  return {{"f0_hz",
           "Hz",
           6.0 * cycle_hz,
           0.1 * cycle_hz,
           40.0 * cycle_hz,
           {2.0 * cycle_hz, 5.0 * cycle_hz},
           ParameterScale::kLogarithmic},
          {"zeta", "", 0.5, 0.01, 5.0, {0.3}, ParameterScale::kLogarithmic},
          {"b1", "", 1.0, 0.0, 10.0, {0.1}},
          {"b2", "", 1.0, 0.0, 10.0, {0.1}}};
}

inline Response FreeSection(double frequency_hz, EffectValues x) {
  const Response u(0.0, frequency_hz / x[0]);
  return (1.0 + x[2] * u + x[3] * u * u) / (1.0 + 2.0 * x[1] * u + u * u);
}

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOCALISE_FREE_FACTOR_H_
