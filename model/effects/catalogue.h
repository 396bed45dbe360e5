// The catalogue of effects: what howl tries to explain a gap with. An effect is one file in forms/;
// it joins the catalogue by its line in HOWL_EFFECTS. Where the physics leaves a form open (a
// filter of first or second order, a spread before or after the flame) there is one member for each
// form, all with the effect's identifier.
#ifndef HOWL_MODEL_EFFECTS_CATALOGUE_H_
#define HOWL_MODEL_EFFECTS_CATALOGUE_H_

#include <vector>

#include "model/effects/effect.h"

namespace howl {

// The registry: the function that gives an effect's forms, which its file defines. The order is
// that in which effects are told.
#define HOWL_EFFECTS(X)      \
  X(QSensorLowPass)          \
  X(QSensorHighPass)         \
  X(FlameLowPass)            \
  X(PSensorResonance)        \
  X(PSensorHighPass)         \
  X(ChannelSkew)             \
  X(ExtraAcousticMode)       \
  X(ModeDetuning)            \
  X(DelayDispersion)         \
  X(DelayVariesWithPhi)      \
  X(AmplitudeDependentDelay) \
  X(NonlinearDamping)        \
  X(ParametricNoise)         \
  X(SlowDrift)               \
  X(Intermittency)           \
  X(PClipping)               \
  X(QClipping)               \
  X(Quantisation)            \
  X(MainsHum)                \
  X(CrosstalkPToQ)           \
  X(SecondDelayPath)         \
  X(ExternalTone)

// The base that effects are added to.
struct CatalogueBase {
  int modes = 2;
  double harmonic_ratio = kPaperHarmonicRatio;
};

#define HOWL_EFFECT_FORMS(Name) std::vector<EffectPointer> Name(const CatalogueBase& base = {});
HOWL_EFFECTS(HOWL_EFFECT_FORMS)
#undef HOWL_EFFECT_FORMS

// A form that only a simulation can tell apart: it is not tried on records.
std::vector<EffectPointer> MainsHumInPressure();

// The effects for a base with so many modes. With one mode there is none to detune.
std::vector<EffectPointer> Catalogue(int modes = 2, double harmonic_ratio = kPaperHarmonicRatio);
// The catalogue with the forms that only a simulation can tell apart.
std::vector<EffectPointer> SimulationCatalogue();

}  // namespace howl

#endif  // HOWL_MODEL_EFFECTS_CATALOGUE_H_
