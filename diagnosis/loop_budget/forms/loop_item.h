// What a budget of records adds to a loop, one at a time:
//
//   p_sensor_noise, q_sensor_noise   the sensor's noise is coloured (the base's is white)
//   duct_noise                       a source in the duct that q does not show
//   background_noise                 one that both channels show without the loop
//   mains_hum                        lines at multiples of 50 or 60 Hz in one of the channels, or
//                                    the one of them at which p stands out (tone.h)
//   external_tone                    another source drives the duct at one frequency (tone.h)
//   parametric_noise                 the flame's gain fluctuates, behind its curve or before it
//                                    (noise_shape.h)
//   noise_shape                      spectra of sources have twice as many coefficients: peaks half
//                                    an octave wide
//   mode_detuning                    the modes' frequencies are free of the base's ratio
//   own_damping                      each mode has its own
//   complex_residues                 p is measured elsewhere than the flame is, or there is flow
//   extra_acoustic_mode              one more mode, with its own frequency and damping; it may be
//                                    added repeatedly
//   delay_dispersion                 delays are spread, normally (flame_path.h)
//   gamma_delays                     or as behind a chain of lags
//   second_delay_path                a share of the flame answers later
//   flame_input_pressure, _velocity  the flame answers to another signal than the base's
//   ID of the catalogue              an instrument, or a filter of the flame, with parameters
//                                    that all points share (shared_effect.h); a second path and a
//                                    spread before the flame's curve are among them
//   nonlinear_damping, amplitude_dependent_delay, amplitude_dependent_gain, slow_drift
//                                    damping, delay and the flame's gain follow the cycle's
//                                    amplitude with a memory, frequencies drift within the record
//                                    (slow_changes.h)
//   acoustic_line_errors, flame_line_errors
//                                    free errors at the cycle's lines (loop_point.h): no cause, but
//                                    what stands in its place where none is known
//
// Of the others each operating point has its own values, about a law that all of them tell
// (parameter_law.h).
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_ITEM_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_ITEM_H_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"
#include "model/effects/effect.h"

namespace howl {

// Coefficients of a source's logarithm over the band's: as many as show peaks an octave wide of a
// source that the loop shapes, and half an octave more of a sensor's.
inline constexpr Eigen::Index kSourceCoefficients = 6;
inline constexpr Eigen::Index kSensorCoefficients = 4;
// Of hum: its level, and the powers of the first multiples that the band has. Rectifiers of six
// pulses and of twelve make the 5th to the 13th (IEC 61000-3-6).
inline constexpr Eigen::Index kHumCoefficients = 1 + 13;

enum class LoopItemKind : std::uint8_t {
  kNoise,
  kNoiseShape,
  kDetuning,
  kOwnDamping,
  kComplexResidues,
  kMode,
  kDelaySpread,
  kSecondPath,
  kFlameInput,
  kSharedEffect,
  kSlowChange,
  kLineErrors
};

struct LoopItem {
  std::string id;
  LoopItemKind kind = LoopItemKind::kMode;
  NoiseTerm noise = {};                          // of kNoise
  DelaySpread spread = DelaySpread::kNone;       // of kDelaySpread
  FlameInput input = FlameInput::kPressureRate;  // of kFlameInput
  EffectPointer effect = nullptr;                // of kSharedEffect: one form of the effect
  int PointStructure::*lines = nullptr;          // of kLineErrors
  bool PointStructure::*change = nullptr;        // of kSlowChange
};

std::vector<std::string> LoopItemIds();
// Where in the loop it lies.
LoopBlock BlockOf(const LoopItem& item);
// Of an item that has several, as configs tell it: "side before_flame"; else empty.
std::string FormOf(const LoopItem& item);
// In keys of finished units (fit_units.h): forms of one effect are different items.
std::string KeyOf(const LoopItem& item);

LoopItem SharedItem(const EffectPointer& effect);

// Forms of a shared effect are items of their own.
const std::vector<LoopItem>& AllLoopItems();

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_ITEM_H_
