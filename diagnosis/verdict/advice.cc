#include "diagnosis/verdict/advice.h"

#include <algorithm>
#include <string_view>

#include "diagnosis/verdict/verdict.h"

namespace howl {

std::string Advice(const Diagnosis& diagnosis, bool model_free) {
  if (diagnosis.kind == VerdictKind::kNone) {
    return "nothing to separate; longer records would lower the floor";
  }
  if (diagnosis.kind == VerdictKind::kUnknown) {
    return "a stable operating point, or a loudspeaker's sweep, would give the transfer functions "
           "of both cuts without the cycle";
  }
  // True if the effect was found alone or in a combination.
  const auto has = [&](std::string_view id) {
    const auto names = [&](const std::string& effect) {
      return effect.find(id) != std::string::npos;
    };
    return names(diagnosis.effect) || std::any_of(diagnosis.indistinguishable.begin(),
                                                  diagnosis.indistinguishable.end(), names);
  };
  if (!model_free && diagnosis.bootstrap_gains.empty() &&
      diagnosis.candidates[0].gain < kNearNoise) {
    return "--bootstrap 19 tells whether noise alone, on a rig like this, gains as much";
  }
  const bool clipped_alone = diagnosis.effect == "p_clipping" || diagnosis.effect == "q_clipping";
  if (clipped_alone || (diagnosis.indistinguishable.empty() && has("_clipping"))) {
    return "record again within the sensor's range: what its plateaus cut off can hide a weaker "
           "effect";
  }
  if (diagnosis.indistinguishable.empty()) return "the effect stands alone: no further experiment";
  if (has("delay_dispersion") || has("second_delay_path") || has("flame_lowpass")) {
    return "a point with a stronger line near the second crossing, or a stable, noise-driven one: "
           "the flame's response above three times the cycle separates these";
  }
  if (has("nonlinear_damping") || has("amplitude_dependent_delay")) {
    return "a point with a weaker cycle: two amplitudes separate these";
  }
  if (has("parametric_noise") || has("intermittency") || has("slow_drift")) {
    return "a record ten times as long: the statistics of the slow envelope separate these";
  }
  return "another operating point, as far away as the rig allows";
}

}  // namespace howl
