// Reference mode: what the reference has too is absorbed, and only the difference is named.
#include "diagnosis/reference/reference.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "bench/measured_rig.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/noise/cut_noise.h"
#include "model/effects/catalogue.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::reference_test {
namespace {

// The fits that take longest, and are beside the point here.
const std::vector<std::string> kSlow = {"p_sensor_resonance", "extra_acoustic_mode",
                                        "delay_dispersion", "second_delay_path"};

TEST(Reference, OnesLeaveEveryBitAsItWas) {
  const std::vector<CutRecord> plain = MakeCutRecords({SimulateRig()[0]});
  std::vector<CutRecord> with = plain;
  CutReference& ones = with[0].reference;
  ones.acoustic.setOnes(plain[0].extended());
  ones.flame.setOnes(plain[0].flame_count + 2 * kTapReach);
  ones.acoustic_share.setOnes(plain[0].acoustic_count);
  const AcousticLocals locals(std::log(206.0), std::log(0.17), 6400.0, 1700.0);
  const Effect& base = *BaseEffect();
  const auto compare = [&](const Effect& effect, EffectValues x) {
    const Eigen::VectorXcd acoustic = AcousticResidual(plain[0], effect, x, locals);
    EXPECT_TRUE(AcousticResidual(with[0], effect, x, locals) == acoustic) << effect.id();
    const FlameColumns columns = MakeFlameColumns(plain[0], effect, x, 0.0035);
    const Eigen::VectorXd weight =
        FlameWeights(plain[0], Eigen::VectorXd::Constant(plain[0].flame_count, 0.7));
    EXPECT_TRUE(FlameWeights(with[0], Eigen::VectorXd::Constant(plain[0].flame_count, 0.7)) ==
                weight);
    const Eigen::VectorXcd flame =
        SolveFlame(plain[0], effect, x, 0.0035, columns, weight).residual;
    EXPECT_TRUE(SolveFlame(with[0], effect, x, 0.0035, columns, weight).residual == flame);
    const Eigen::VectorXd variance = Eigen::VectorXd::Constant(acoustic.size(), 0.3);
    EXPECT_EQ(AcousticCost(with[0], acoustic, variance),
              AcousticCost(plain[0], acoustic, variance));
  };
  compare(base, {});
  compare(*QSensorLowPass()[0], std::vector<double>{400.0});
}

// Both have a low-pass on q, which no base has: the model's shortcoming, not the rig's difference.
TEST(LongReference, WhatBothHaveIsNotNamed) {
  const std::shared_ptr<const Instrument> low_pass =
      std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0);
  DiagnosisOptions options;
  options.withheld = kSlow;
  options.reference = SimulateRig({low_pass}, 7);
  std::vector<DiagnosisExperiment> rig = SimulateRig({low_pass}, 70);
  const Diagnosis same = Diagnose(rig, options);
  EXPECT_EQ(same.kind, VerdictKind::kNone) << same.effect;

  // The rig has a skew in addition.
  SkewQ(&rig, 2e-4);
  const Diagnosis skewed = Diagnose(rig, options);
  ASSERT_EQ(skewed.kind, VerdictKind::kEffect);
  EXPECT_EQ(skewed.effect, "channel_skew");
  ASSERT_FALSE(skewed.candidates.empty());
  EXPECT_NEAR(skewed.candidates[0].parameters.at(0).value, 2e-4, 2e-5);
  EXPECT_EQ(skewed.where.at(0).block, LoopBlock::kHeatReleaseInstrument);
}

// The factors against a known one: what the base predicts of p, times 1 + 0.3 j f / f0.
TEST(Reference, FactorsAreTheTransferThatTheBaseLacks) {
  const std::vector<DiagnosisExperiment> rig = SimulateRig();
  std::vector<CutRecord> records = MakeCutRecords(rig);
  EffectFit fit = FitBase(records);
  for (std::size_t e = 0; e < records.size(); ++e) {
    CutRecord& record = records[e];
    Eigen::VectorXcd& residual = fit.experiments[e].acoustic_residual;
    const Eigen::VectorXcd predicted = record.windowed_pressure - residual;
    for (Eigen::Index k = 0; k < record.acoustic_count; ++k) {
      const double u = record.frequency(k) / record.at.cycle_frequency_hz;
      record.windowed_pressure[k] = predicted[k] * Response(1.0, 0.3 * u);
    }
    residual = record.windowed_pressure - predicted;
  }
  for (const ReferencePoint& point : DescribeReference(rig, records, fit)) {
    for (const double u : {0.5, 1.0, 1.4, 2.2, 3.1}) {
      const auto i = static_cast<Eigen::Index>(std::lround(u / kReferenceStep));
      // The kernel reaches 0.12 in u, where a stronger line may pull it.
      EXPECT_LT(std::abs(point.acoustic[i] - Response(1.0, 0.3 * u)), 0.3 * 0.12) << u;
    }
  }
}

TEST(Reference, PointsBetweenAreInterpolated) {
  ReferencePoint a;
  a.name = "a";
  a.phi = 1.0;
  a.acoustic = Eigen::VectorXcd::Constant(4, Response(1.0, 0.0));
  a.flame = a.acoustic;
  a.acoustic_shape = Eigen::VectorXd::Constant(4, 1.0);
  a.flame_shape = a.acoustic_shape;
  ReferencePoint b = a;
  b.name = "b";
  b.phi = 3.0;
  b.acoustic.setConstant(Response(2.0, 4.0));
  b.acoustic_shape.setConstant(100.0);
  const ReferencePoint between = PointAt({a, b}, "c", 1.5);
  EXPECT_LT(std::abs(between.acoustic[2] - Response(1.25, 1.0)), 1e-15);
  EXPECT_NEAR(between.acoustic_shape[2], std::pow(100.0, 0.25), 1e-12);
  EXPECT_EQ(PointAt({a, b}, "b", 1.5).phi, 3.0);
  EXPECT_EQ(PointAt({a, b}, "c", 9.0).phi, 3.0);
}

MeasuredRig ReadCombustor(const std::string& folder) {
  MeasuredRig rig;
  const std::pair<const char*, double> points[] = {
      {"p14", 585.0}, {"p17", 642.0}, {"p19", 687.0}, {"p21", 750.0}};
  for (const auto& [name, air_slpm] : points) {
    gzFile file = gzopen((folder + "/turbulent_combustor/" + name + ".txt.gz").c_str(), "rb");
    if (!file) return {};
    std::string text;
    char buffer[1 << 16];
    for (int n = 0; (n = gzread(file, buffer, sizeof buffer)) > 0;) {
      text.append(buffer, static_cast<std::size_t>(n));
    }
    gzclose(file);
    DiagnosisExperiment each{name, air_slpm, {}};
    each.record.sampling_hz = 1e4;
    std::istringstream lines(text);
    for (double t = 0.0, q = 0.0, p = 0.0; lines >> t >> q >> p;) {
      each.record.heat_release.push_back(q);
      each.record.pressure.push_back(p);
    }
    rig.push_back(std::move(each));
  }
  return rig;
}

// The measured combustor, which no model of the catalogue explains: its first half in time is the
// reference, its second half the rig.
TEST(LongReference, NamesKnownEffectsInMeasuredRecords) {
  const char* folder = std::getenv("HOWL_DATA");
  if (!folder) GTEST_SKIP() << "HOWL_DATA is not set";
  const MeasuredRig all = ReadCombustor(folder);
  if (all.empty()) GTEST_SKIP() << "no turbulent combustor in HOWL_DATA";
  DiagnosisOptions options;
  options.withheld = kSlow;
  options.reference = Part(all, 0.0, 0.5);
  const MeasuredRig rig = Part(all, 0.5, 1.0);
  EXPECT_EQ(Diagnose(rig, options).kind, VerdictKind::kNone);

  MeasuredRig skewed = rig;
  SkewQ(&skewed, 6e-4);
  const Diagnosis skew = Diagnose(skewed, options);
  ASSERT_EQ(skew.kind, VerdictKind::kEffect);
  EXPECT_EQ(skew.effect, "channel_skew");
  EXPECT_NEAR(skew.candidates.at(0).parameters.at(0).value, 6e-4, 1e-4);

  MeasuredRig slow = rig;
  LowPassQ(&slow, 300.0);
  const Diagnosis low_pass = Diagnose(slow, options);
  ASSERT_EQ(low_pass.kind, VerdictKind::kEffect);
  EXPECT_EQ(low_pass.effect, "q_sensor_lowpass");
}

}  // namespace
}  // namespace howl::reference_test
