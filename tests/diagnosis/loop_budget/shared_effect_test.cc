// Instruments, and filters of the flame, that records show, and those that they do not.
#include "diagnosis/loop_budget/forms/shared_effect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "diagnosis/loop_budget/trials/effect_ranges.h"
#include "diagnosis/loop_budget/trials/shared_effect_trial.h"
#include "estimation/record_fit/whittle/noise_shape.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::shared_effect_test {
namespace {

std::vector<LoopRecord> Ducts(const ModalInstruments& instruments) {
  return DuctsAt({1.2, 1.5, 1.8}, instruments);
}

// Of the loop itself, each effect tried beside it, or each form of one alone.
std::vector<LoopTrial> TrialsOn(const std::vector<LoopRecord>& rig, const std::string& id = "") {
  const LoopRecords records(rig, 0);
  LoopBudgetOptions options;
  options.starts = 4;
  const LoopFit from = DuctsFit(records, options);
  const double standing = StandingEvidence(records, from, "", options);
  std::vector<LoopTrial> out;
  for (const LoopItem& item : AllLoopItems()) {
    if (item.kind != LoopItemKind::kSharedEffect || (!id.empty() && item.id != id)) continue;
    out.push_back(TryFarFromNull(records, from, standing,
                                 TrySharedEffect(records, from, standing, item, "", options), "",
                                 options));
  }
  return out;
}

// From the loop itself, with no other items offered.
LoopDiagnosis DiagnosisWith(const std::vector<LoopRecord>& rig,
                            const std::vector<std::string>& offered) {
  return DiagnoseLoops(rig, DuctsForm(), Among(offered));
}

// The loop is a special case of each: no more is lost than the parameter's prior asks.
TEST(SharedEffect, CostsItsPriorWhereThereIsNone) {
  for (const LoopTrial& trial : TrialsOn(Ducts({}))) {
    EXPECT_GT(trial.gain, -15.0) << KeyOf(trial.item);
    EXPECT_LT(trial.gain, 3.0) << KeyOf(trial.item);
  }
}

// When a second path's share is nothing its records tell nothing of when it comes.
TEST(SharedEffect, IntervalsEndWhereTheRangesDo) {
  const LoopRecords records(Ducts({}), 0);
  LoopBudgetOptions options;
  options.starts = 4;
  const std::vector<LoopItem>& items = AllLoopItems();
  const LoopItem path = *std::ranges::find_if(items, [](const LoopItem& item) {
    return item.id == "second_delay_path" && item.kind == LoopItemKind::kSharedEffect;
  });
  LoopFit fit = DuctsFit(records, options);
  fit.model = With(fit.model, path);
  const Effect& effect = *fit.model.effects.back().effect;
  const std::vector<EstimatedParameter> found =
      EstimateSharedEffect(records, fit, path, "", options);
  ASSERT_EQ(found.size(), effect.parameters().size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const EffectParameter& parameter = effect.parameters()[i];
    const double factor = RangeFactor(effect, parameter, records);
    EXPECT_GE(found[i].low, (1.0 - 1e-12) * factor * parameter.low) << found[i].name;
    EXPECT_LE(found[i].high, (1.0 + 1e-12) * factor * parameter.high) << found[i].name;
    EXPECT_LE(found[i].low, found[i].value) << found[i].name;
    EXPECT_GE(found[i].high, found[i].value) << found[i].name;
  }
}

LoopTrial BestOf(const std::vector<LoopTrial>& trials) {
  return *std::ranges::max_element(trials, {}, &LoopTrial::gain);
}

TEST(LongSharedEffect, FindsAStrongLowPass) {
  const std::vector<LoopTrial> trials =
      TrialsOn(Ducts([](Record* record) { LowPass(120.0, record); }));
  EXPECT_EQ(BestOf(trials).item.id, "q_sensor_lowpass");
  EXPECT_GT(BestOf(trials).gain, 100.0);
  EXPECT_NEAR(BestOf(trials).model.effects.back().values[0], 120.0, 2.0);
}

// It turns the cycle's phase by 70 degrees: behind it the loop's delay lies at another maximum than
// the loop that knows of no filter has taken.
TEST(LongSharedEffect, FindsALowPassFarBelowTheCycle) {
  const std::vector<LoopRecord> rig = Ducts([](Record* record) { LowPass(70.0, record); });
  const LoopTrial best = BestOf(TrialsOn(rig, "q_sensor_lowpass"));
  EXPECT_NEAR(best.model.effects.back().values[0], 70.0, 1.5);
}

// From where the middles of the records begin, one record of this rig comes to a lesser maximum
// behind a filter of first order alone, which makes that of second order look the better one.
TEST(SharedEffect, FindsAWeakLowPassInItsOwnOrder) {
  constexpr double kCutoff_hz = 2000.0;
  std::vector<LoopRecord> rig;
  for (const double gain : {1.2, 1.5, 1.8}) {
    rig.push_back(
        DuctAt(gain, 1.6, rig.size() + 1, [](Record* record) { LowPass(kCutoff_hz, record); }));
  }
  const LoopTrial best = BestOf(TrialsOn(rig, "q_sensor_lowpass"));
  EXPECT_EQ(best.item.effect->form().value, "1");
  EXPECT_NEAR(best.model.effects.back().values[0], kCutoff_hz, 60.0);
}

TEST(LongSharedEffect, FindsAStrongLeak) {
  constexpr double kLeak = 0.5;
  const auto ratio_of = [](const Record& record) {
    return RootMeanSquare(record.heat_release) / RootMeanSquare(record.pressure);
  };
  double relative_to_record = 0.0;  // a leak is stated over q as it is recorded
  const std::vector<LoopRecord> rig = Ducts([&](Record* record) {
    const double before = ratio_of(*record);
    Leak(kLeak, record);
    relative_to_record += kLeak * before / ratio_of(*record) / 3.0;
  });
  const std::vector<LoopTrial> trials = TrialsOn(rig);
  EXPECT_EQ(BestOf(trials).item.id, "crosstalk_p_to_q");
  EXPECT_GT(BestOf(trials).gain, 100.0);
  EXPECT_NEAR(BestOf(trials).model.effects.back().values[0], relative_to_record, 0.01);
}

std::vector<LoopRecord> Changed(double duration_s, const std::function<void(ModalLoop*)>& change) {
  std::vector<LoopRecord> out;
  for (const double gain : {1.2, 1.5, 1.8}) {
    out.push_back(DuctAt(gain, duration_s, static_cast<std::uint64_t>(100.0 * gain), {}, change));
  }
  return out;
}

TEST(LongSharedEffect, FindsASecondPathBeforeTheCurve) {
  const std::vector<LoopTrial> trials = TrialsOn(Changed(4.0, [](ModalLoop* loop) {
    loop->share = 0.25;
    loop->later_s = 1e-3;
  }));
  EXPECT_EQ(KeyOf(BestOf(trials).item), "second_delay_pathbefore_flame");
  // Two values that are told to a few hundredths of their ranges.
  EXPECT_GT(BestOf(trials).price, 4.0);
  EXPECT_LT(BestOf(trials).price, 15.0);
  EXPECT_GT(BestOf(trials).gain, 50.0);
  const std::vector<double> values = BestOf(trials).model.effects.back().values;
  ASSERT_EQ(values.size(), 2u);
  EXPECT_NEAR(values[0], 0.25, 0.04);
  EXPECT_NEAR(values[1], 1e-3, 8e-5);
}

// Newton's steps from the null foretell 9 nats, and lead to a path that is later by 0.5 ms.
TEST(SharedEffect, FindsASecondPathFarFromItsNull) {
  const LoopTrial best = BestOf(TrialsOn(Changed(0.8,
                                                 [](ModalLoop* loop) {
                                                   loop->share = 0.3;
                                                   loop->later_s = 7e-3;
                                                 }),
                                         std::string(kSecondPathId)));
  EXPECT_EQ(KeyOf(best.item), "second_delay_pathbefore_flame");
  EXPECT_GT(best.gain, 60.0);
  const std::vector<double> values = best.model.effects.back().values;
  ASSERT_EQ(values.size(), 2u);
  EXPECT_NEAR(values[0], 0.3, 0.06);
  EXPECT_NEAR(values[1], 7e-3, 2e-4);
}

// The loop's own spread, behind the curve, is as good to first order.
TEST(SharedEffect, FindsASpreadBeforeTheCurve) {
  const std::vector<LoopRecord> rig = Changed(1.6, [](ModalLoop* loop) { loop->spread_s = 3e-4; });
  const LoopDiagnosis found = DiagnosisWith(rig, {std::string(kDelayDispersionId)});
  const std::vector<BudgetEntry>& entries = found.diagnosis.budget->entries;
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].form, "side before_flame");
  const EstimatedParameter& spread = entries[0].parameters[0];
  EXPECT_LT(spread.low, 3e-4);
  EXPECT_GT(spread.high, 3e-4);
  EXPECT_NEAR(spread.value, 3e-4, 4e-5);
}

// The laws of a loop that was fitted without the resonance hold its modes where they are not: a
// trial names it, and the search beyond the trial finds its values.
// So it does where the same samples are of a rig that is eight times as slow.
TEST(LongSharedEffect, FindsAResonanceOfThePressureSensor) {
  std::vector<LoopRecord> rig = Ducts([](Record* record) {
    const auto resonance = [](double hz) {
      const std::complex<double> s(0.0, hz / 900.0);
      return 1.0 / (1.0 + 0.2 * s + s * s);
    };
    Filter(resonance, record->sampling_hz, &record->pressure);
  });
  const LoopTrial best = BestOf(TrialsOn(rig));
  EXPECT_EQ(best.item.id, "p_sensor_resonance");
  EXPECT_GT(best.gain, 100.0);
  for (const double faster : {1.0, 0.125}) {
    for (LoopRecord& each : rig) {
      each.record.sampling_hz *= faster;
      each.cycle_hz *= faster;
    }
    const LoopDiagnosis found = DiagnosisWith(rig, {"p_sensor_resonance"});
    ASSERT_EQ(found.diagnosis.budget->entries.size(), 1u);
    const std::vector<EstimatedParameter>& parameters =
        found.diagnosis.budget->entries[0].parameters;
    ASSERT_EQ(parameters.size(), 2u);
    EXPECT_NEAR(parameters[0].value, faster * 900.0, faster * 6.0);
    EXPECT_NEAR(parameters[1].value, 0.1, 0.006);
  }
}

// A signal without a mean, which a high-pass leaves none of, tells the loop all the same. Free
// modes with complex residues do much of what a high-pass does: what it gains beside them is what
// an item must gain to come in.
// Of 30 Hz that of p is worth 16 nats in records as short as these, as a weak second path is: the
// last digits of linear algebra would choose between them.
TEST(LongSharedEffect, FindsHighPassesOfEitherSensor) {
  constexpr double kCutoff_hz = 60.0;
  const auto response = [](double hz) {
    return std::complex<double>(0.0, hz) / std::complex<double>(kCutoff_hz, hz);
  };
  for (const auto& [id, signal] : {std::pair{"p_sensor_highpass", &Record::pressure},
                                   std::pair{"q_sensor_highpass", &Record::heat_release}}) {
    const std::vector<LoopRecord> rig = Ducts([&, signal = signal](Record* record) {
      Filter(response, record->sampling_hz, &(record->*signal));
    });
    const LoopTrial best = BestOf(TrialsOn(rig));
    EXPECT_EQ(best.item.id, id);
    EXPECT_GT(best.gain, std::log(kOddsOfItem * static_cast<double>(AllLoopItems().size())));
    EXPECT_NEAR(best.model.effects.back().values[0], kCutoff_hz, 2.0);
  }
}

TEST(SharedEffect, FindsALagOfTheFlame) {
  const std::vector<LoopTrial> trials =
      TrialsOn(Changed(0.8, [](ModalLoop* loop) { loop->lag_hz = 300.0; }));
  EXPECT_EQ(BestOf(trials).item.id, "flame_lowpass");
  EXPECT_GT(BestOf(trials).gain, 100.0);
  EXPECT_NEAR(BestOf(trials).model.effects.back().values[0], 300.0, 15.0);
}

// A second path, and a spread of delays, stands behind the curve or before it.
TEST(SharedEffect, StandsOnOneSideOfTheCurve) {
  for (const std::string_view id : {kSecondPathId, kDelayDispersionId}) {
    const auto offered = [&](const LoopForm& form) {
      return std::ranges::count(LoopItems(form, DuctsForm()), id, &LoopItem::id);
    };
    EXPECT_EQ(offered(DuctsForm()), 2);
    for (const LoopItem& item : LoopItems(DuctsForm(), DuctsForm())) {
      if (item.id != id) continue;
      EXPECT_EQ(offered(With(DuctsForm(), item)), 0) << KeyOf(item);
    }
  }
}

EffectPointer NamedEffectOf(std::string_view id) {
  const std::vector<EffectPointer> effects = SharedEffects();
  return *std::ranges::find(effects, id, [](const EffectPointer& effect) { return effect->id(); });
}

// What the loop is fitted to moves with what was recorded as the matrix says.
TEST(SharedEffect, MovesWithWhatWasRecorded) {
  const LoopRecord of = DuctAt(1.5, 0.8, 1);
  const RecordSpectra plain = MakeRecordSpectra(of.record, of.cycle_hz, FlameInput::kPressureRate);
  const std::vector<SharedEffect> effects = {{NamedEffectOf("q_sensor_lowpass"), {300.0}},
                                             {NamedEffectOf("p_sensor_resonance"), {900.0, 0.1}},
                                             {NamedEffectOf("crosstalk_p_to_q"), {0.3}}};
  const RecordSpectra before = RecordBeside(plain, effects);
  for (const Eigen::Index bin : {Eigen::Index{20}, Eigen::Index{300}}) {
    for (const int channel : {0, 1}) {
      RecordSpectra moved = plain;
      (channel == 0 ? moved.pressure : moved.heat_release)[bin] += 1.0;
      moved = RecordBeside(std::move(moved), effects);
      const Eigen::Vector2cd by = ByRecorded(effects, of.cycle_hz, plain.edge_s[bin]).col(channel);
      EXPECT_LT(std::abs(moved.pressure[bin] - before.pressure[bin] - by[0]), 1e-9);
      EXPECT_LT(std::abs(moved.heat_release[bin] - before.heat_release[bin] - by[1]), 1e-9);
    }
  }
}

// What the loop is fitted to is p as it was before the resonance, but for its size and its turn at
// the cycle.
TEST(SharedEffect, TakesAResonanceOut) {
  const LoopRecord of = DuctAt(1.5, 0.8, 1);
  const RecordSpectra plain = MakeRecordSpectra(of.record, of.cycle_hz, FlameInput::kPressureRate);
  const EffectPointer resonance = NamedEffectOf("p_sensor_resonance");
  const SharedEffect shared{resonance, {900.0, 0.1}};
  const RecordSpectra record = RecordBeside(plain, {shared});
  const auto response = [&](double hz) { return resonance->PressureInstrument(hz, shared.values); };
  const std::complex<double> at_cycle = response(of.cycle_hz);
  double log_jacobian = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const double hz = record.edge_s[i].imag() * of.cycle_hz;
    const std::complex<double> h = response(hz) / std::abs(at_cycle);
    EXPECT_LT(std::abs(record.pressure[i] * h - plain.pressure[i]),
              1e-12 * std::abs(plain.pressure[i]));
    const double at_bin_hz = record.s[i].imag() * of.cycle_hz;
    const double power = std::norm(response(at_bin_hz) / at_cycle);
    EXPECT_NEAR(NoiseShape({LoopNoise::kPressureSensor, 1}, record)[i], 1.0 / power, 1e-9 / power);
    log_jacobian -= record.share[i] * std::log(power);
  }
  EXPECT_NEAR(LogJacobian(plain, {shared}), log_jacobian, 1e-9 * std::abs(log_jacobian));
  // The flame of what was recorded at the cycle has the same phase as that of what it sees.
  const std::complex<double> j(0.0, 1.0);
  EXPECT_NEAR(std::arg(record.InputAt(j) / response(of.cycle_hz)), std::arg(plain.InputAt(j)),
              1e-12);
  // Noise that the fit tells beside it is that of the record through it.
  Eigen::VectorXd noise = Eigen::VectorXd::Zero(plain.Samples());
  for (Eigen::Index n = 0; n < noise.size(); ++n) {
    noise[n] = std::cos(2.0 * std::numbers::pi * 100.0 * static_cast<double>(n) /
                        static_cast<double>(noise.size()));
  }
  const Eigen::VectorXd recorded = PressureAsRecorded(plain, {shared}, noise);
  const double size = std::abs(response(100.0 * plain.bin_hz) / at_cycle);
  EXPECT_NEAR(recorded.norm() / noise.norm(), size, 1e-9);
}

TEST(SharedEffect, ShapesTheNoiseBehindIt) {
  LoopRecord of = DuctAt(1.5, 0.8, 1);
  const RecordSpectra plain = MakeRecordSpectra(of.record, of.cycle_hz, FlameInput::kPressureRate);
  const RecordSpectra record = RecordBeside(plain, {{SharedEffects()[0], {300.0}}});
  const NoiseTerm sensor{LoopNoise::kHeatReleaseSensor, 1};
  const Eigen::VectorXd shape = NoiseShape(sensor, record);
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const double hz = record.s[i].imag() * record.scale.cycle_hz;
    EXPECT_NEAR(shape[i], 1.0 + std::pow(hz / 300.0, 2), 1e-9 * shape[i]);
  }
  EXPECT_EQ(NoiseShape({LoopNoise::kCombustion, 6}, record), NoiseShape(sensor, plain));
}

// White noise of the sensor's electronics comes in behind its low-pass, and stays white there.
TEST(LongSharedEffect, HasNoColouredNoiseBesideIt) {
  const std::vector<LoopRecord> rig = Ducts([](Record* record) { LowPass(150.0, record); });
  const LoopDiagnosis found = DiagnosisWith(rig, {"q_sensor_lowpass", "q_sensor_noise"});
  EXPECT_EQ(found.diagnosis.effect, "q_sensor_lowpass");
}

// A lag of the flame's answer adds its phase lag at the cycle to the loop's delay.
TEST(SharedEffect, TurnsTheCycle) {
  const std::vector<EffectPointer> effects = SharedEffects();
  const auto lag = std::ranges::find(
      effects, "flame_lowpass", [](const EffectPointer& each) { return std::string(each->id()); });
  ASSERT_NE(lag, effects.end());
  EXPECT_NEAR(TurnOfCycle({{*lag, {300.0}}}, 200.0), std::atan(200.0 / 300.0), 1e-12);
  EXPECT_EQ(TurnOfCycle({{*lag, {(*lag)->parameters()[0].null_value}}}, 200.0), 0.0);
  EXPECT_EQ(TurnOfCycle({}, 200.0), 0.0);
}

}  // namespace
}  // namespace howl::shared_effect_test
