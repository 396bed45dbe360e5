// Effects that a user declares, in the diagnosis: named where they are the cause, and the same as
// the catalogue's where they say the same.
#include "model/effects/declared_effect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "diagnosis/candidates/declared_fit.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/diagnosis.h"
#include "model/effects/catalogue.h"
#include "model/numerics/constants.h"
#include "tests/diagnosis/declare.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::declared_effect_test {
namespace {

EffectPointer Make(EffectDeclaration declaration) {
  return std::make_shared<DeclaredEffect>(std::move(declaration));
}

const std::vector<DiagnosisExperiment>& CleanRig() {
  static const std::vector<DiagnosisExperiment> rig = SimulateRig();
  return rig;
}

// All but the quickest of the catalogue's fits that act on both cuts.
std::vector<std::string> AllBut(const std::vector<std::string>& kept) {
  std::vector<std::string> withheld;
  for (const EffectPointer& effect : Catalogue()) {
    const std::string id(effect->id());
    if (std::find(kept.begin(), kept.end(), id) == kept.end()) withheld.push_back(id);
  }
  return withheld;
}

TEST(DeclaredEffects, ACatalogueEffectDeclaredAgainHasTheSameFit) {
  const std::vector<CutRecord> records = MakeCutRecords(
      SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)}));
  const EffectFit base = FitBase(records);
  const EffectPointer known = QSensorLowPass()[0];
  const EffectPointer mine =
      Make(Declare("cable", LoopPlace::kHeatReleaseRecorded, DeclaredForm::kTransfer,
                   "1 / (1 + s / (2 * pi * cutoff_hz))", known->parameters()[0]));
  const EffectFit a = FitEffect(records, known, base);
  const EffectFit b = FitEffect(records, mine, base);
  EXPECT_NEAR(b.cost(), a.cost(), 1e-3);
  EXPECT_NEAR(b.values[0], a.values[0], 1e-4 * a.values[0]);
  EXPECT_NEAR(b.tau_s, a.tau_s, 1e-5 * a.tau_s);
}

// An amplifier coupled to q through a capacitor: no effect of the catalogue.
TEST(DeclaredEffects, NamesAnEffectThatTheCatalogueLacks) {
  constexpr double kCorner_hz = 60.0;
  std::vector<DiagnosisExperiment> rig = CleanRig();
  for (DiagnosisExperiment& experiment : rig) {
    std::vector<double>& q = experiment.record.heat_release;
    const double w = 2.0 * std::numbers::pi * kCorner_hz / experiment.record.sampling_hz;
    double before = 0.0;
    double out = 0.0;
    for (double& value : q) {
      out = (2.0 * (value - before) + (2.0 - w) * out) / (2.0 + w);
      before = value;
      value = out;
    }
  }
  DiagnosisOptions options;
  options.withheld = AllBut({"channel_skew", "crosstalk_p_to_q", "flame_lowpass"});
  EffectParameter corner{"corner_hz", "Hz", 0.0, 1.0, 150.0, {20.0, 80.0}};
  options.further = {
      Make(Declare("capacitor", LoopPlace::kHeatReleaseRecorded, DeclaredForm::kTransfer,
                   "s / (s + 2 * pi * corner_hz)", corner))};
  const Diagnosis diagnosis = Diagnose(rig, options);
  ASSERT_EQ(diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(diagnosis.effect, "capacitor");
  EXPECT_EQ(diagnosis.where.at(0).block, LoopBlock::kHeatReleaseInstrument);
  ASSERT_EQ(diagnosis.candidates.at(0).parameters.size(), 1u);
  EXPECT_NEAR(diagnosis.candidates[0].parameters[0].value, kCorner_hz, 3.0);
}

// The photomultiplier bends: y = x / (1 + |x| / limit).
TEST(LongDeclaredEffects, EstimatesAStaticMapOfQ) {
  std::vector<DiagnosisExperiment> rig = CleanRig();
  double largest = 0.0;
  for (const double q : rig[0].record.heat_release) largest = std::max(largest, std::abs(q));
  const double limit = 4.0 * largest;
  for (DiagnosisExperiment& experiment : rig) {
    for (double& q : experiment.record.heat_release) q = q / (1.0 + std::abs(q) / limit);
  }
  EffectParameter parameter{
      "limit", "", kInfinity, 0.5 * largest, 100.0 * largest, {2.0 * largest, 20.0 * largest}};
  parameter.scale = ParameterScale::kLogarithmic;
  const EffectPointer effect =
      Make(Declare("soft_limit", LoopPlace::kHeatReleaseRecorded, DeclaredForm::kMap,
                   "x / (1 + abs(x) / limit)", parameter));
  const std::vector<CutRecord> records = MakeCutRecords(rig);
  const EffectFit base = FitBase(records);
  const DeclaredMapFit fit =
      FitDeclaredMap(rig, records, base, dynamic_cast<const DeclaredEffect&>(*effect));
  EXPECT_GT(fit.gain, 100.0);
  EXPECT_NEAR(fit.values[0] / limit, 1.0, 0.03);
  // On the straight record it is not needed.
  const std::vector<CutRecord> straight = MakeCutRecords(CleanRig());
  EXPECT_LT(FitDeclaredMap(CleanRig(), straight, FitBase(straight),
                           dynamic_cast<const DeclaredEffect&>(*effect))
                .gain,
            10.0);
}

// A fan's tone, in the acoustics. Not at a multiple of the mains' frequency.
TEST(DeclaredEffects, NamesALineByItsPlace) {
  std::vector<DiagnosisExperiment> rig = CleanRig();
  for (DiagnosisExperiment& experiment : rig) {
    for (std::size_t i = 0; i < experiment.record.pressure.size(); ++i) {
      const double t = static_cast<double>(i) / experiment.record.sampling_hz;
      experiment.record.pressure[i] += 0.3 * std::sin(2.0 * std::numbers::pi * 88.0 * t + 0.3);
    }
  }
  const std::vector<CutRecord> records = MakeCutRecords(rig);
  const std::vector<CoherentLine> lines = FindCoherentLines(records);
  ASSERT_FALSE(lines.empty());
  const EffectFit base = FitBase(records);
  const auto gain = [&](LoopPlace place, double low_hz, double high_hz) {
    EffectDeclaration declaration;
    declaration.name = "fan";
    declaration.place = place;
    declaration.form = DeclaredForm::kLine;
    declaration.line_low_hz = low_hz;
    declaration.line_high_hz = high_hz;
    return FitDeclaredLine(records, base, lines, DeclaredEffect(declaration)).gain;
  };
  const double recorded = gain(LoopPlace::kPressureRecorded, 85.0, 90.0);
  EXPECT_GT(recorded, 100.0);
  EXPECT_GT(recorded, gain(LoopPlace::kHeatReleaseRecorded, 85.0, 90.0));
  EXPECT_EQ(gain(LoopPlace::kPressureRecorded, 90.0, 120.0), 0.0);
}

}  // namespace
}  // namespace howl::declared_effect_test
