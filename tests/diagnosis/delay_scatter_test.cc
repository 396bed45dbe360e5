// Delays that scatter over the experiments are found, and their width.
#include "diagnosis/delay_scatter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "diagnosis/effect_fit.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl {
namespace {

constexpr double kOff[] = {0.021, -0.034, 0.027, -0.012};

std::vector<DiagnosisExperiment> RigWithDelays(const std::vector<double>& factors) {
  std::size_t next = 0;
  return SimulatePoints(
      static_cast<int>(factors.size()),
      [&](RigParameters* rig) { rig->model.loop.tau_s *= factors[next++]; }, 21);
}

std::vector<double> Scattered() {
  std::vector<double> factors;
  for (const double off : kOff) factors.push_back(std::exp(off));
  return factors;
}

// Half above and half below by a, each known to 1 / sqrt(I): s^2 = a^2 - 1 / I.
TEST(DelayScatter, TheLikeliestWidthOfAlikeRecords) {
  const double a = 0.02;
  const double information = 1e6;
  const std::vector<OwnDelay> delays = {{0.0, 0.1 + a, information}, {0.0, 0.1 - a, information}};
  const DelayScatter found = FitScatter(delays, 1.0);
  EXPECT_NEAR(found.mean, 0.1, 1e-12);
  EXPECT_NEAR(found.standard_deviation, std::sqrt(a * a - 1.0 / information), 0.02 * a);
  EXPECT_EQ(FitScatter(delays, 0.01).standard_deviation, 0.01);
  // Closer together than their errors: one delay.
  const std::vector<OwnDelay> same = {{0.0, 5e-4, information}, {0.0, -5e-4, information}};
  EXPECT_EQ(FitScatter(same, 1.0).standard_deviation, 0.0);
}

// The integral over d_e of the record's likelihood under the scatter, by the trapezoidal rule.
TEST(DelayScatter, TheCostIsThatOfTheIntegral) {
  const double s = 0.013;
  OwnDelay delay{0.0, 0.02, 2e4};
  delay.log_delay = ShrunkenDelay(delay, {0.0, s});
  double integral = 0.0;
  const double step = 1e-5;
  for (double d = -0.2; d < 0.2; d += step) {
    const double off = d - delay.optimum;
    integral += step * std::exp(-0.5 * delay.information * off * off - 0.5 * d * d / (s * s)) /
                (s * std::sqrt(2.0 * std::numbers::pi));
  }
  const double off = delay.log_delay - delay.optimum;
  const double residual = 0.5 * delay.information * off * off;
  EXPECT_NEAR(residual + ScatterCost({delay}, s), -std::log(integral), 1e-9);
}

TEST(DelayScatter, EachExperimentsDelayIsFound) {
  const std::vector<CutRecord> records =
      MakeCutRecords(RigWithDelays(Scattered()), {.delay_scatter_max = 0.1});
  const EffectFit fit = FitBase(records);
  double mean_square = 0.0;
  for (std::size_t e = 0; e < std::size(kOff); ++e) {
    EXPECT_NEAR(std::log(fit.DelayOf(e) / 0.00352), kOff[e], 1.5e-3);
    mean_square += kOff[e] * kOff[e] / static_cast<double>(std::size(kOff));
  }
  EXPECT_NEAR(fit.delay_scatter, std::sqrt(mean_square), 2e-3);
}

TEST(DelayScatter, OneDelayForAllStaysOne) {
  const EffectFit fit = FitBase(MakeCutRecords(SimulateRig(), {.delay_scatter_max = 0.1}));
  EXPECT_LT(fit.delay_scatter, 1e-3);
}

}  // namespace
}  // namespace howl
