#include "diagnosis/verdict/advice.h"

#include <algorithm>
#include <string>
#include <vector>

#include "diagnosis/verdict/verdict.h"
#include "model/effects/catalogue.h"

namespace howl {

std::string Advice(const Diagnosis& diagnosis, bool model_free) {
  if (diagnosis.kind == VerdictKind::kNone) {
    return "nothing to separate; longer records would lower the floor";
  }
  if (diagnosis.kind == VerdictKind::kUnknown) {
    return "a stable operating point, or a loudspeaker's sweep, would give the transfer functions "
           "of both cuts without the cycle";
  }
  const std::vector<EffectPointer> catalogue =
      Catalogue(diagnosis.model.modes, diagnosis.model.harmonic_ratio);
  // True if such an effect was found alone or in a combination.
  const auto has = [&](const auto& is) {
    return std::ranges::any_of(catalogue, [&](const EffectPointer& effect) {
      const auto names = [&](const std::string& found) {
        return found.find(effect->id()) != std::string::npos;
      };
      return is(*effect) &&
             (names(diagnosis.effect) || std::ranges::any_of(diagnosis.indistinguishable, names));
    });
  };
  const auto separated_by = [&](Separation by) {
    return has([by](const Effect& effect) { return effect.SeparatedBy() == by; });
  };
  if (!model_free && diagnosis.bootstrap_gains.empty() &&
      diagnosis.candidates[0].gain < kNearNoise) {
    return "--bootstrap 19 tells whether noise alone, on a rig like this, gains as much";
  }
  const auto changes_samples = [](const Effect& effect) {
    return effect.kind() == EffectKind::kClipping || effect.kind() == EffectKind::kQuantisation;
  };
  if (diagnosis.indistinguishable.empty() && has(changes_samples)) return kRecordAgain;
  if (diagnosis.indistinguishable.empty()) return "the effect stands alone: no further experiment";
  if (separated_by(Separation::kHighFrequencies)) {
    return "a point with a stronger line near the second crossing, or a stable, noise-driven one: "
           "the flame's response above three times the cycle separates these";
  }
  if (separated_by(Separation::kCycleAmplitude)) {
    return "a point with a weaker cycle: two amplitudes separate these";
  }
  if (separated_by(Separation::kLongRecord)) {
    return "a record ten times as long: the statistics of the slow envelope separate these";
  }
  return "another operating point, as far away as the rig allows";
}

}  // namespace howl
