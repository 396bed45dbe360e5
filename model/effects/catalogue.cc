#include "model/effects/catalogue.h"

namespace howl {

std::vector<EffectPointer> Catalogue(int modes, double harmonic_ratio) {
  const CatalogueBase base{modes, harmonic_ratio};
  std::vector<EffectPointer> all;
  const auto add = [&](const std::vector<EffectPointer>& forms) {
    all.insert(all.end(), forms.begin(), forms.end());
  };
#define HOWL_ADD_EFFECT(Name) add(Name(base));
  HOWL_EFFECTS(HOWL_ADD_EFFECT)
#undef HOWL_ADD_EFFECT
  return all;
}

std::vector<EffectPointer> SimulationCatalogue() {
  std::vector<EffectPointer> all = Catalogue();
  const std::vector<EffectPointer> more = MainsHumInPressure();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace howl
