// What a budget of records adds to a loop, one at a time:
//
//   p_sensor_noise, q_sensor_noise   the sensor's noise is coloured (the base's is white)
//   duct_noise                       a source in the duct that q does not show
//   background_noise                 one that both channels show without the loop
//   mode_detuning                    the modes' frequencies are free of the base's ratio
//   own_damping                      each mode has its own
//   complex_residues                 p is measured elsewhere than the flame is, or there is flow
//   acoustic_mode                    one more mode; it may be added repeatedly
//   delay_dispersion                 delays are spread, normally (flame_path.h)
//   gamma_delays                     or as behind a chain of lags
//   flame_input_pressure, _velocity  the flame answers to another signal than the base's
//   ID of the catalogue              an instrument of q with one parameter, which all points share
//                                    (loop_instrument.h)
//
// Of the others each operating point has its own values, about a law that all of them tell
// (parameter_law.h).
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_ITEM_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_ITEM_H_

#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_instrument.h"
#include "estimation/record_fit/loop/loop_point.h"

namespace howl {

struct LoopForm {
  PointStructure structure;
  FlameInput flame_input = FlameInput::kPressureRate;
  std::vector<LoopInstrument> instruments;
};

enum class LoopItemKind : std::uint8_t {
  kNoise,
  kDetuning,
  kOwnDamping,
  kComplexResidues,
  kMode,
  kDelaySpread,
  kFlameInput,
  kInstrument
};

struct LoopItem {
  std::string id;
  LoopItemKind kind = LoopItemKind::kMode;
  NoiseTerm noise = {};                          // of kNoise
  DelaySpread spread = DelaySpread::kNone;       // of kDelaySpread
  FlameInput input = FlameInput::kPressureRate;  // of kFlameInput
  EffectPointer instrument = nullptr;            // of kInstrument: one form of the effect
};

// The least noise that a rig has: combustion's, coloured, and white noise of both sensors.
std::vector<NoiseTerm> LeastNoise();

std::vector<std::string> LoopItemIds();
// In keys of finished units (fit_units.h): forms of one effect are different items.
std::string KeyOf(const LoopItem& item);

// All that may be added to `model` now, of a search that began at `base`.
std::vector<LoopItem> LoopItems(const LoopForm& model, const LoopForm& base);

// An instrument comes at its null.
LoopForm With(LoopForm model, const LoopItem& item);
// `model` has the item, which `base` has not. Modes that were added need frequencies and dampings
// of their own: without either they go as well.
LoopForm Without(LoopForm model, const LoopItem& item, const LoopForm& base);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_ITEM_H_
