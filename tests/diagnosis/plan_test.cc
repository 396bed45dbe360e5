// What a plan promises against what fits and diagnoses of simulated rigs find.
#include "diagnosis/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/plan/effect_line.h"
#include "diagnosis/plan/plan_gains.h"
#include "model/effects/catalogue.h"
#include "model/effects/declared_effect.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::plan_test {
namespace {

EffectPointer Named(const std::string& id) {
  for (const EffectPointer& effect : Catalogue()) {
    if (effect->id() == id) return effect;
  }
  ADD_FAILURE() << id;
  return nullptr;
}

// An effect with its values held, so that a fit of it fits the base's parameters alone.
class Held final : public NamedEffect {
 public:
  Held(EffectPointer effect, std::vector<double> values)
      : NamedEffect("held", effect->block(), {}),
        effect_(std::move(effect)),
        values_(std::move(values)) {}
  bool ChangesAcousticCut() const override { return effect_->ChangesAcousticCut(); }
  bool ChangesFlameCut() const override { return effect_->ChangesFlameCut(); }
  bool ChangesFlameInput() const override { return effect_->ChangesFlameInput(); }
  bool ModulatesAcoustics() const override { return effect_->ModulatesAcoustics(); }
  Response HeatReleaseInstrument(double f, EffectValues /*x*/) const override {
    return effect_->HeatReleaseInstrument(f, values_);
  }
  Response FlameIn(double f, const EffectContext& at, EffectValues /*x*/) const override {
    return effect_->FlameIn(f, at, values_);
  }
  Response FlameOut(double f, const EffectContext& at, EffectValues /*x*/) const override {
    return effect_->FlameOut(f, at, values_);
  }
  double DelayFactor(const EffectContext& at, EffectValues /*x*/) const override {
    return effect_->DelayFactor(at, values_);
  }
  void ModulateAcoustics(double position, double amplitude, EffectValues /*x*/,
                         double* omega_factor, double* xi_add) const override {
    effect_->ModulateAcoustics(position, amplitude, values_, omega_factor, xi_add);
  }

 private:
  EffectPointer effect_;
  std::vector<double> values_;
};

// An effect without a line would be left out of the plan in silence.
TEST(Plan, EveryTransferFunctionOfTheCatalogueHasASize) {
  for (const int modes : {1, 2}) {
    const std::vector<CutRecord> records =
        MakeCutRecords(SimulateRig(), {.modes = modes, .harmonic_ratio = 2.9});
    int transfer_functions = 0;
    for (const EffectPointer& effect : Catalogue(modes, 2.9)) {
      if (effect->kind() != EffectKind::kTransfer) continue;
      ++transfer_functions;
      EXPECT_FALSE(EffectLines(effect, records[0]).empty()) << effect->id();
    }
    EXPECT_GE(transfer_functions, 12);
  }
}

// The gain to first order is what a full fit of the base's parameters loses when the effect is
// held in the model of records that do not have it.
TEST(Plan, GainsAreThoseOfAFitWithTheEffectHeld) {
  const std::vector<CutRecord> records =
      MakeCutRecords(SimulateRig(), {.modes = 2, .own_delays = false});
  const EffectFit base = FitBase(records);
  std::vector<std::unique_ptr<PlanPoint>> points;
  for (std::size_t e = 0; e < records.size(); ++e) {
    points.push_back(std::make_unique<PlanPoint>(records[e], base, e));
  }
  for (const std::string id : {"flame_lowpass", "delay_dispersion", "q_sensor_lowpass",
                               "channel_skew", "slow_drift", "delay_varies_with_phi"}) {
    const EffectPointer effect = Named(id);
    const EffectLine line = EffectLines(effect, records[0])[0];
    // The size at which the gain is some hundreds of nats, which noise changes by a tenth.
    double size = line.typical;
    double gain = 0.0;
    for (int i = 0; i < 12; ++i) {
      std::vector<PointProducts> products;
      for (const auto& point : points) {
        products.push_back(SquaresOf(*point, {line}, {{0, size}}, 1.0));
      }
      gain = PlanGains(std::move(products), {}).Gain(0, effect->parameters().size());
      if (gain > 150.0 && gain < 300.0) break;
      size *= std::pow(200.0 / gain, 0.4);
    }
    const EffectFit held =
        FitEffect(records, std::make_shared<Held>(effect, line.ValuesAt(size)), base);
    const double by_fit = held.cost() - base.cost();
    EXPECT_GT(by_fit, gain / 2.0) << id << " at " << line.ParameterAt(size);
    EXPECT_LT(by_fit, gain * 2.0) << id << " at " << line.ParameterAt(size);
  }
}

Plan PlanAmong(const std::vector<std::string>& kept, const std::vector<DiagnosisExperiment>& rig,
               std::vector<EffectPointer> further = {}) {
  PlanOptions options;
  options.withheld = AllBut(kept);
  options.further = std::move(further);
  return MakePlan(rig, options);
}

// The rig of tests/diagnosis/simulated_rig.h with an effect of the catalogue in it.
std::vector<DiagnosisExperiment> RigWith(const PlannedEffect& planned, double value,
                                         std::uint64_t seed) {
  const EffectPointer effect = Named(planned.effect);
  SimulationScale scale;
  scale.duration_s = 3.7;  // with the half second that is thrown away
  return SimulatePoints(
      3,
      [&](RigParameters* rig) {
        EXPECT_TRUE(effect->AddTo(scale, {&value, 1}, rig));
      },
      seed);
}

// What a fit of the effect gains over the base, its parameter not paid for.
double GainByFit(const std::string& id, const std::vector<DiagnosisExperiment>& rig) {
  const std::vector<CutRecord> records = MakeCutRecords(rig, {.modes = 2, .own_delays = false});
  const EffectFit base = FitBase(records);
  return GainOver(base, FitBestForm(nullptr, "", records, {Named(id)}, base));
}

// Noise changes a gain of G by the root of 2 G, which the mean of three rigs makes less of.
TEST(LongPlan, AnEffectOfTwiceTheSmallestSizeGainsWhatIsPlannedAndOneOfAFifthNothing) {
  const std::vector<std::string> ids = {"channel_skew", "delay_dispersion", "slow_drift"};
  const Plan plan = PlanAmong(ids, SimulateRig());
  ASSERT_EQ(plan.effects.size(), ids.size());
  for (const PlannedEffect& planned : plan.effects) {
    ASSERT_TRUE(std::isfinite(planned.size.smallest)) << planned.effect;
    double gain = 0.0;
    for (const std::uint64_t seed : {31u, 41u, 51u}) {
      const double one = GainByFit(planned.effect, RigWith(planned, planned.reference, seed));
      EXPECT_GT(one, planned.gain_needed) << planned.effect << " at " << planned.reference;
      gain += one / 3.0;
    }
    EXPECT_GT(gain, planned.reference_gain / 2.0) << planned.effect << " at " << planned.reference;
    EXPECT_LT(gain, planned.reference_gain * 2.0) << planned.effect << " at " << planned.reference;
    const double fifth =
        planned.from_infinity ? 5.0 * planned.size.smallest : 0.2 * planned.size.smallest;
    EXPECT_LT(GainByFit(planned.effect, RigWith(planned, fifth, 31)), planned.gain_needed)
        << planned.effect << " at " << fifth;
  }
}

TEST(LongPlan, WhatIsPlannedIsDiagnosed) {
  for (const std::string id : {"channel_skew", "delay_dispersion", "slow_drift"}) {
    const PlannedEffect planned = PlanAmong({id}, SimulateRig()).effects.at(0);
    const Diagnosis found = DiagnoseAmong({id}, RigWith(planned, planned.reference, 31));
    EXPECT_EQ(found.kind, VerdictKind::kEffect) << id;
    const double fifth =
        planned.from_infinity ? 5.0 * planned.size.smallest : 0.2 * planned.size.smallest;
    EXPECT_EQ(DiagnoseAmong({id}, RigWith(planned, fifth, 31)).kind, VerdictKind::kNone) << id;
  }
}

// q that comes late, declared as a user would: the catalogue's skew under another name.
TEST(Plan, OneEffectUnderTwoNamesIsOneClass) {
  EffectDeclaration late;
  late.name = "late_q";
  late.place = LoopPlace::kHeatReleaseRecorded;
  late.form = DeclaredForm::kDelay;
  late.parameters = {{"late_s", "", 0.0, -3e-3, 3e-3, {4e-4}}};
  FormulaError error;
  const auto parsed =
      DeclaredFormula::Parse("late_s", late.place, late.form, late.parameters, error);
  ASSERT_TRUE(parsed.has_value()) << error.message;
  late.numerator = {*parsed};
  const Plan plan = PlanAmong({"channel_skew", "slow_drift"}, SimulateRig(),
                              {std::make_shared<DeclaredEffect>(late)});
  ASSERT_EQ(plan.effects.size(), 3u);
  EXPECT_NEAR(plan.effects[0].size.smallest / plan.effects[2].size.smallest, 1.0, 1e-6);
  EXPECT_EQ(plan.classes, (std::vector<std::vector<std::string>>{{"channel_skew", "late_q"}}));
  // Nothing that can be measured separates one thing from itself, and a drift is another thing.
  ASSERT_EQ(plan.pairs.size(), 1u);
  EXPECT_GE(plan.pairs[0].trials.size(), 5u);
  for (const PlannedTrial& trial : plan.pairs[0].trials) {
    EXPECT_LT(trial.nats, trial.nats_needed) << trial.what;
  }
}

// A lag is a delay and, to second order, a spread of it: 1 / (1 + T s) and e^(-T s + (T s)^2 / 2).
// At a stable point, where the flame answers noise alone, only third orders tell them apart.
TEST(Plan, ASmallLagIsASpreadOfTheDelay) {
  const std::vector<DiagnosisExperiment> stable = SimulatePoints(
      3, [](RigParameters* rig) { rig->model.flame.slope *= 0.55; }, 7);
  const Plan plan =
      PlanAmong({"flame_lowpass", "delay_dispersion", "delay_varies_with_phi"}, stable);
  ASSERT_EQ(plan.effects.size(), 3u);
  const PlannedEffect& lag = plan.effects[0];
  const PlannedEffect& spread = plan.effects[1];
  ASSERT_TRUE(std::isfinite(lag.size.smallest));
  const double lag_s = 1.0 / (2.0 * std::numbers::pi * lag.size.smallest);
  EXPECT_NEAR(lag_s / spread.size.smallest, 1.0, 0.3);
  const auto rival = std::ranges::find(lag.rivals, "delay_dispersion", &PlannedRival::effect);
  ASSERT_NE(rival, lag.rivals.end());
  // At the smallest size they are one; a lag half as long again is no spread any more.
  EXPECT_LT(rival->told_apart_at, 0.9 * lag.size.smallest);
  EXPECT_GT(rival->told_apart_at, 0.5 * lag.size.smallest);
}

TEST(Plan, IsTheSameForAnyNumberOfThreads) {
  PlanOptions options;
  options.withheld = AllBut({"channel_skew", "flame_lowpass", "mains_hum"});
  options.threads = 1;
  const Plan one = MakePlan(SimulateRig(), options);
  options.threads = 3;
  const Plan three = MakePlan(SimulateRig(), options);
  ASSERT_EQ(one.effects.size(), 3u);
  for (std::size_t i = 0; i < one.effects.size(); ++i) {
    EXPECT_EQ(one.effects[i].size.smallest, three.effects[i].size.smallest);
    EXPECT_EQ(one.effects[i].reference_gain, three.effects[i].reference_gain);
  }
}

}  // namespace
}  // namespace howl::plan_test
