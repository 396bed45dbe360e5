#include "estimation/analysis/transfer/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "estimation/analysis/analyse.h"
#include "estimation/analysis/transfer/transfer_ellipsoid.h"
#include "estimation/family/problem/membership.h"
#include "tests/estimation/analysis/measured_data.h"

namespace howl::transfer_test {
namespace {

const Acoustics<double> kRig{204.0, 0.15, 5500.0, 2000.0, kPaperHarmonicRatio};

TransferPoint PointOf(const Acoustics<double>& acoustics, double frequency_hz,
                      double relative_std) {
  const Complex<double> g = AcousticResponse(acoustics, frequency_hz);
  TransferPoint point;
  point.frequency_hz = frequency_hz;
  point.re = g.re;
  point.im = g.im;
  point.variance_re = point.variance_im = 0.5 * relative_std * relative_std * SquaredMagnitude(g);
  point.weight = SquaredMagnitude(g);
  return point;
}

ModelSpec TwoModes() {
  ModelSpec model = DefaultModelSpec();
  model.modes = 2;
  return model;
}

TEST(FitTransfer, RecoversTheRigFromExactPoints) {
  Transfer transfer;
  for (double f = 60.0; f < 1000.0; f += 10.0) transfer.points.push_back(PointOf(kRig, f, 0.01));
  const TransferFit fit = FitTransfer(transfer, TwoModes());
  ASSERT_TRUE(fit.available);
  EXPECT_NEAR(fit.omega_hz.value, 204.0, 1e-4);
  EXPECT_NEAR(fit.xi.value, 0.15, 1e-6);
  EXPECT_NEAR(fit.N.value, 5500.0, 1e-2);
  EXPECT_NEAR(fit.M.value, 2000.0, 1e-2);
  EXPECT_NEAR(fit.explained_power, 1.0, 1e-9);
  EXPECT_EQ(fit.model_error, 0.0);
}

TEST(FitTransfer, IntervalsCover) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  int covered = 0;
  constexpr int kTrials = 60;
  for (int trial = 0; trial < kTrials; ++trial) {
    Transfer transfer;
    for (double f = 60.0; f < 800.0; f += 12.0) {
      TransferPoint point = PointOf(kRig, f, 0.1);
      point.re += std::sqrt(point.variance_re) * normal(random);
      point.im += std::sqrt(point.variance_im) * normal(random);
      transfer.points.push_back(point);
    }
    const TransferFit fit = FitTransfer(transfer, TwoModes());
    const auto holds = [](const Estimate& e, double truth) {
      return std::abs(e.value - truth) < kNormal95 * e.std ? 1 : 0;
    };
    covered += holds(fit.omega_hz, kRig.omega_hz) + holds(fit.xi, kRig.xi) + holds(fit.N, kRig.N) +
               holds(fit.M, kRig.M);
  }
  EXPECT_GT(covered, 0.91 * 4 * kTrials);
}

// One mode in a config means one mode in the fit: a rig with one is found, and its M is not.
TEST(FitTransfer, HasTheModelsModesAndNoOthers) {
  const Acoustics<double> rig{204.0, 0.15, 5500.0, 0.0, kPaperHarmonicRatio};
  Transfer transfer;
  for (double f = 60.0; f < 1000.0; f += 10.0) transfer.points.push_back(PointOf(rig, f, 0.01));
  const TransferFit fit = FitTransfer(transfer, DefaultModelSpec());
  ASSERT_TRUE(fit.available);
  EXPECT_NEAR(fit.omega_hz.value, 204.0, 1e-4);
  EXPECT_NEAR(fit.xi.value, 0.15, 1e-6);
  EXPECT_NEAR(fit.N.value, 5500.0, 1e-2);
  EXPECT_EQ(fit.M.value, 0.0);
  const auto ellipsoid = MakeTransferEllipsoid(fit);
  ASSERT_TRUE(ellipsoid.has_value());
  EXPECT_FALSE(ellipsoid->IsDetermined(3));
  EXPECT_NEAR(TransferDistance(*ellipsoid, {.omega_hz = 204.0, .xi = 0.15, .N = 5500.0}), 0.0,
              1e-3);
}

// What is not known of q's noise is the same at all points: it moves N by as much as if there were
// one point, however many there are.
TEST(FitTransfer, DoubtOfTheNoiseFloorDoesNotAverageOut) {
  for (const double step_hz : {20.0, 1.0}) {
    Transfer transfer;
    for (double f = 60.0; f < 800.0; f += step_hz) {
      TransferPoint point = PointOf(kRig, f, 0.01);
      point.q_noise_bias = 0.03;
      transfer.points.push_back(point);
    }
    const TransferFit fit = FitTransfer(transfer, TwoModes());
    EXPECT_GT(fit.N.std / fit.N.value, 0.03 * kQNoiseLevelStd) << step_hz;
    EXPECT_LT(fit.N.std / fit.N.value, 1.4 * 0.03 * kQNoiseLevelStd) << step_hz;
    EXPECT_LT(fit.omega_hz.std / fit.omega_hz.value, 0.01) << step_hz;
  }
}

// A second mode that is not there has no logarithm: the transfer says nothing of it, and must not
// be taken to know it.
TEST(FitTransfer, SecondModeOfVanishingSizeIsNotDetermined) {
  const Acoustics<double> rig{204.0, 0.15, 5500.0, 0.0, kPaperHarmonicRatio};
  Transfer transfer;
  for (double f = 60.0; f < 1000.0; f += 10.0) transfer.points.push_back(PointOf(rig, f, 0.1));
  const TransferFit fit = FitTransfer(transfer, TwoModes(), TransferBandOf(TwoModes(), 210.0),
                                      FirstModeCarries{210.0, 0.1});
  ASSERT_TRUE(fit.available);
  EXPECT_GT(fit.M.std, fit.M.value);
  const auto ellipsoid = MakeTransferEllipsoid(fit);
  ASSERT_TRUE(ellipsoid.has_value());
  EXPECT_TRUE(ellipsoid->IsDetermined(2));
  EXPECT_FALSE(ellipsoid->IsDetermined(3));
}

// A third mode that the model lacks: the fit has to say that it falls short, and where.
TEST(FitTransfer, ModelErrorIsReportedPointByPoint) {
  Transfer transfer;
  const Acoustics<double> extra{430.0, 0.02, 600.0, 0.0, kPaperHarmonicRatio};
  for (double f = 60.0; f < 1000.0; f += 10.0) {
    TransferPoint point = PointOf(kRig, f, 0.02);
    const Complex<double> g = AcousticResponse(extra, f);
    point.re += g.re;
    point.im += g.im;
    transfer.points.push_back(point);
  }
  const TransferFit fit = FitTransfer(transfer, TwoModes());
  EXPECT_GT(fit.chi_square_per_dof, 5.0);
  EXPECT_GT(fit.model_error, 0.05);
  const auto worst =
      std::max_element(fit.points.begin(), fit.points.end(),
                       [](const auto& a, const auto& b) { return a.misfit < b.misfit; });
  EXPECT_NEAR(worst->frequency_hz, 430.0, 15.0);
}

// Practice rigs without any effect: a simulator that shares no code with this project.
TEST(PracticeRigs, TransferGivesOmegaXiNAndM) {
  const auto folder = fixtures::DataFolder("HOWL_PRACTICE");
  if (!folder) GTEST_SKIP() << "HOWL_PRACTICE is not set";
  for (const char* rig : {"case002", "case022", "case023"}) {
    double xi = 0, n = 0, ratio = 0, ratio_weight = 0;
    for (int e = 1; e <= 6; ++e) {
      const Record record = fixtures::PracticeRecord(*folder, rig, e);
      ASSERT_EQ(record.pressure.size(), 16000u) << rig;
      const Analysis analysis = AnalyseRecord(record, {.model = TwoModes()});
      const auto truth = [&](const char* key) {
        return fixtures::PracticeTruth(*folder, rig, e, key);
      };
      ASSERT_TRUE(analysis.transfer_fit.has_value());
      const TransferFit& fit = *analysis.transfer_fit;
      EXPECT_NEAR(fit.omega_hz.value, truth("omega_hz"), 0.005 * truth("omega_hz")) << rig << e;
      EXPECT_NEAR(fit.xi.value, truth("xi"), 0.03 * truth("xi")) << rig << e;
      EXPECT_NEAR(fit.N.value, truth("N"), 0.02 * truth("N")) << rig << e;
      EXPECT_NEAR(fit.M.value / truth("M"), 1.0, 3.5 * fit.M.std / fit.M.value) << rig << e;
      EXPECT_GT(fit.explained_power, 0.99) << rig << e;
      EXPECT_LT(fit.chi_square_per_dof, 1.5) << rig << e;
      xi += fit.xi.value / truth("xi") / 6.0;
      n += fit.N.value / truth("N") / 6.0;
      const double weight = std::pow(fit.M.value / fit.M.std, 2);
      ratio += weight * fit.M.value / fit.N.value / (truth("M") / truth("N"));
      ratio_weight += weight;
    }
    EXPECT_NEAR(xi, 1.0, 0.01) << rig;
    EXPECT_NEAR(n, 1.0, 0.01) << rig;
    EXPECT_NEAR(ratio / ratio_weight, 1.0, 0.025) << rig;  // one for the rig, 1 % standard error
  }
}

// Rigs whose effect leaves p = G q alone: the true model's squared distance is chi-square with four
// degrees of freedom, of mean 4 and below 9.49 in 95 % of the records.
TEST(PracticeRigs, TrueModelsLieWithinTheTransfersEllipsoids) {
  const auto folder = fixtures::DataFolder("HOWL_PRACTICE");
  if (!folder) GTEST_SKIP() << "HOWL_PRACTICE is not set";
  double mean = 0.0;
  int count = 0, within = 0, beyond_default = 0;
  for (const char* rig :
       {"case002", "case006", "case008", "case015", "case019", "case022", "case023"}) {
    for (int e = 1; e <= 6; ++e) {
      const Analysis analysis =
          AnalyseRecord(fixtures::PracticeRecord(*folder, rig, e), {.model = TwoModes()});
      ASSERT_TRUE(analysis.transfer_fit.has_value());
      const auto ellipsoid = MakeTransferEllipsoid(*analysis.transfer_fit);
      ASSERT_TRUE(ellipsoid.has_value()) << rig << e;
      const auto truth = [&](const char* key) {
        return fixtures::PracticeTruth(*folder, rig, e, key);
      };
      const LoopModel loop{
          .omega_hz = truth("omega_hz"), .xi = truth("xi"), .N = truth("N"), .M = truth("M")};
      const double distance = MahalanobisDistance(*ellipsoid, loop);
      mean += distance * distance;
      within += distance * distance <= 9.488;
      beyond_default += TransferDistance(*ellipsoid, loop) > MembershipTest{}.transfer_distance_max;
      ++count;
    }
  }
  mean /= count;
  // Four standard errors of the mean; at most six of 42 beyond the 95 % quantile (99 % binomial).
  EXPECT_NEAR(mean, 4.0, 4.0 * std::sqrt(8.0 / count));
  EXPECT_GE(within, 36);
  EXPECT_LE(beyond_default, 1);
}

}  // namespace
}  // namespace howl::transfer_test
