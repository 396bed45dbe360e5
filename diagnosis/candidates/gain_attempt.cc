#include <algorithm>
#include <cmath>

#include "diagnosis/candidates/attempt.h"

namespace howl {

Attempt TryGain(const AttemptContext& at, const Effect& effect,
                const GainFluctuation& fluctuation) {
  Attempt out = Named(at, effect);
  const bool coloured = effect.kind() == EffectKind::kColouredGain;
  const double worse = coloured ? fluctuation.coloured_cost - fluctuation.switching_cost
                                : fluctuation.switching_cost - fluctuation.coloured_cost;
  out.candidate.gain = fluctuation.gain - std::max(0.0, worse);
  if (coloured) {
    out.candidate.parameters.push_back(WithoutError(
        "rel_rms",
        std::sqrt(std::max(
            0.0, std::pow(fluctuation.in_phase_std, 2) - std::pow(fluctuation.quadrature_std, 2))),
        ""));
    out.candidate.parameters.push_back(
        WithoutError("correlation_s", fluctuation.correlation_s, "s"));
  } else {
    out.candidate.parameters.push_back(WithoutError("gain_drop", 1.0 - fluctuation.low_level, ""));
    out.candidate.parameters.push_back(WithoutError("dwell_s", fluctuation.dwell_s, "s"));
  }
  for (std::size_t e = 0; e < out.held_out.size(); ++e) {
    out.held_out[e].flame_residual = fluctuation.corrected[e];
  }
  return out;
}

}  // namespace howl
