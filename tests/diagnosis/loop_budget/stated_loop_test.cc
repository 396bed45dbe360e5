// What a config says of a loop that was found: formulas against the catalogue's own responses.
#include "diagnosis/loop_budget/account/stated_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/forms/shared_effect.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/analysis/instruments/instrument_response.h"
#include "estimation/analysis/instruments/remove_instruments.h"
#include "model/effects/effect.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::stated_loop_test {
namespace {

// Values somewhere inside the range.
SharedEffect Somewhere(const EffectPointer& effect) {
  SharedEffect out{effect, {}};
  for (const EffectParameter& parameter : effect->parameters()) {
    out.values.push_back(parameter.starts.front());
  }
  return out;
}

TEST(StatedLoop, HasTheInstrumentsResponses) {
  std::size_t formulas = 0;
  for (const EffectPointer& effect : SharedEffects()) {
    const SharedEffect shared = Somewhere(effect);
    const std::string formula = ResponseFormula(shared);
    if (IsFlameFilter(*effect)) {
      EXPECT_EQ(formula, "") << effect->id();
      continue;
    }
    // A skew and a leak have keys of their own.
    if (effect->id() == "channel_skew" || effect->id() == "crosstalk_p_to_q") continue;
    FormulaError error;
    const auto response = InstrumentResponse::Parse(formula, error);
    ASSERT_TRUE(response.has_value()) << effect->id() << " " << formula << " " << error.message;
    ++formulas;
    for (const double hz : {3.0, 70.0, 211.0, 640.0, 2000.0}) {
      const std::complex<double> expected = effect->PressureInstrument(hz, shared.values) *
                                            effect->HeatReleaseInstrument(hz, shared.values);
      EXPECT_LT(std::abs(response->At(hz) / expected - 1.0), 1e-5) << formula << " at " << hz;
    }
  }
  EXPECT_EQ(formulas, 5u);  // two low-passes, two high-passes and a resonance
}

TEST(StatedLoop, SaysNothingOfAnInstrumentAtItsNull) {
  for (const EffectPointer& effect : SharedEffects()) {
    SharedEffect shared = Somewhere(effect);
    shared.values[0] = effect->parameters()[0].null_value;
    EXPECT_EQ(ResponseFormula(shared), "") << effect->id();
  }
}

// The sensor's noise is divided by the instrument with the signal. Who does not know that finds it
// coloured.
TEST(StatedLoop, LeavesNothingToFindInRecordsThatAreCorrectedByIt) {
  constexpr double kCutoff_hz = 150.0;
  const EffectPointer low_pass = SharedEffects().front();
  ASSERT_EQ(low_pass->id(), "q_sensor_lowpass");
  FormulaError error;
  Instruments known;
  known.heat_release = InstrumentResponse::Parse(ResponseFormula({low_pass, {kCutoff_hz}}), error);
  std::vector<LoopRecord> records;
  for (const double gain : {1.2, 1.5, 1.8}) {
    records.push_back(DuctAt(
        gain, 0.8, 7, [](Record* record) { LowPass(kCutoff_hz, record); },
        [](ModalLoop* loop) { loop->sensor_noise = 0.03; }));
  }
  for (LoopRecord& each : records) ASSERT_FALSE(RemoveInstruments(known, each.record).has_value());
  const LoopBudgetOptions how = Among({"q_sensor_noise"});
  const LoopForm right = DuctsForm();
  EXPECT_EQ(DiagnoseLoops(records, right, how).diagnosis.kind, VerdictKind::kNone);
  for (LoopRecord& each : records) each.record.heat_release_instrument = nullptr;
  EXPECT_EQ(DiagnoseLoops(records, right, how).diagnosis.effect, "q_sensor_noise");
}

TEST(StatedLoop, KnowsWhatAConfigCannotSay) {
  std::vector<std::string> not_stated;
  for (const LoopItem& item : AllLoopItems()) {
    if (!IsStated(item)) not_stated.push_back(item.id);
  }
  const auto has = [&](const char* id) {
    return std::ranges::find(not_stated, id) != not_stated.end();
  };
  for (const char* id : {"mains_hum", "external_tone", "parametric_noise", "flame_lowpass",
                         "nonlinear_damping", "amplitude_dependent_delay", "slow_drift"}) {
    EXPECT_TRUE(has(id)) << id;
  }
  for (const char* id : {"duct_noise", "extra_acoustic_mode", "q_sensor_lowpass", "channel_skew",
                         "crosstalk_p_to_q", "p_sensor_resonance", "complex_residues"}) {
    EXPECT_FALSE(has(id)) << id;
  }
}

}  // namespace
}  // namespace howl::stated_loop_test
