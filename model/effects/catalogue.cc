#include "model/effects/catalogue.h"

namespace howl {

std::vector<EffectPointer> Catalogue(int modes, double harmonic_ratio) {
  std::vector<EffectPointer> all;
  for (const auto& form : {QSensorLowPass(),
                           FlameLowPass(),
                           PSensorResonance(),
                           ChannelSkew(),
                           ExtraAcousticMode(modes, harmonic_ratio),
                           modes == 1 ? std::vector<EffectPointer>() : ModeDetuning(harmonic_ratio),
                           DelayDispersion(),
                           DelayVariesWithPhi(),
                           AmplitudeDependentDelay(),
                           NonlinearDamping(),
                           ParametricNoise(),
                           SlowDrift(),
                           Intermittency(),
                           PClipping(),
                           QClipping(),
                           Quantisation(),
                           MainsHum(),
                           CrosstalkPToQ(),
                           SecondDelayPath(),
                           ExternalTone()}) {
    all.insert(all.end(), form.begin(), form.end());
  }
  return all;
}

std::vector<EffectPointer> SimulationCatalogue() {
  std::vector<EffectPointer> all = Catalogue();
  const std::vector<EffectPointer> more = MainsHumInPressure();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace howl
