// The catalogue of effects: what howl tries to explain a gap with. An effect is one file here; it
// joins the catalogue by its line in catalogue.cc. Where the physics leaves a form open (a filter
// of first or second order, a spread before or after the flame) there is one member for each form,
// all with the effect's identifier.
#ifndef HOWL_MODEL_EFFECTS_CATALOGUE_H_
#define HOWL_MODEL_EFFECTS_CATALOGUE_H_

#include <memory>
#include <vector>

#include "model/effects/effect.h"

namespace howl {

using EffectPointer = std::shared_ptr<const Effect>;

// The effects for a base with so many modes. With one mode there is none to detune.
std::vector<EffectPointer> Catalogue(int modes = 2, double harmonic_ratio = kPaperHarmonicRatio);
// The catalogue with the forms that only a simulation can tell apart.
std::vector<EffectPointer> SimulationCatalogue();

std::vector<EffectPointer> QSensorLowPass();
std::vector<EffectPointer> FlameLowPass();
std::vector<EffectPointer> PSensorResonance();
std::vector<EffectPointer> ChannelSkew();
std::vector<EffectPointer> ExtraAcousticMode(int modes = 2,
                                             double harmonic_ratio = kPaperHarmonicRatio);
std::vector<EffectPointer> ModeDetuning(double harmonic_ratio = kPaperHarmonicRatio);
std::vector<EffectPointer> DelayDispersion();
std::vector<EffectPointer> DelayVariesWithPhi();
std::vector<EffectPointer> AmplitudeDependentDelay();
std::vector<EffectPointer> NonlinearDamping();
std::vector<EffectPointer> ParametricNoise();
std::vector<EffectPointer> SlowDrift();
std::vector<EffectPointer> Intermittency();
std::vector<EffectPointer> PClipping();
std::vector<EffectPointer> QClipping();
std::vector<EffectPointer> Quantisation();
std::vector<EffectPointer> MainsHum();
std::vector<EffectPointer> MainsHumInPressure();
std::vector<EffectPointer> CrosstalkPToQ();
std::vector<EffectPointer> SecondDelayPath();
std::vector<EffectPointer> ExternalTone();

}  // namespace howl

#endif  // HOWL_MODEL_EFFECTS_CATALOGUE_H_
