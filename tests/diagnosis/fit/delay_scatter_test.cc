// Delays that scatter over the experiments are no gap; a law behind them is.
#include "diagnosis/fit/delay_scatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/effect_fit.h"
#include "model/effects/catalogue.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::delay_scatter_test {
namespace {

constexpr BaseModel kOwnDelays = {.own_delays = true};
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

Diagnosis DiagnoseDelays(const std::vector<DiagnosisExperiment>& rig) {
  DiagnosisOptions options;
  options.withheld = AllBut({"delay_varies_with_phi", "amplitude_dependent_delay", "channel_skew",
                             "second_delay_path", "q_sensor_lowpass", "flame_lowpass"});
  options.model = kOwnDelays;
  return Diagnose(rig, options);
}

// Half above and half below by a, each known to 1 / sqrt(I): s^2 = a^2 - 1 / I.
TEST(DelayScatter, TheLikeliestWidthOfAlikeRecords) {
  const double a = 0.02;
  const double information = 1e6;
  const std::vector<OwnDelay> delays = {{0.0, 0.1 + a, information}, {0.0, 0.1 - a, information}};
  const DelayScatter found = FitScatter(delays);
  EXPECT_NEAR(found.mean, 0.1, 1e-12);
  EXPECT_NEAR(found.standard_deviation, std::sqrt(a * a - 1.0 / information), 0.02 * a);
  // Closer together than their errors: one delay.
  const std::vector<OwnDelay> same = {{0.0, 5e-4, information}, {0.0, -5e-4, information}};
  EXPECT_EQ(FitScatter(same).standard_deviation, 0.0);
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
  const std::vector<CutRecord> records = MakeCutRecords(RigWithDelays(Scattered()), kOwnDelays);
  const EffectFit fit = FitBase(records);
  double mean_square = 0.0;
  for (std::size_t e = 0; e < std::size(kOff); ++e) {
    EXPECT_NEAR(std::log(fit.DelayOf(e) / 0.00352), kOff[e], 1.5e-3);
    mean_square += kOff[e] * kOff[e] / static_cast<double>(std::size(kOff));
  }
  EXPECT_NEAR(fit.delay_scatter, std::sqrt(mean_square), 2e-3);
}

TEST(DelayScatter, OneDelayForAllStaysOne) {
  const EffectFit fit = FitBase(MakeCutRecords(SimulateRig(), kOwnDelays));
  EXPECT_LT(fit.delay_scatter, 1e-3);
}

double LargestGain(const std::vector<CutRecord>& records, const std::vector<EffectPointer>& forms,
                   const EffectFit& base) {
  double most = -HUGE_VAL;
  for (const EffectPointer& form : forms) {
    most = std::max(most, GainOver(base, FitEffect(records, form, base)));
  }
  return most;
}

// Five per cent of the gain of an amplitude that already knows the combustion noise, 100 nats here.
TEST(DelayScatter, TheAmplitudeThatNoiseItselfMakesMovesNoDelay) {
  const std::vector<CutRecord> records = MakeCutRecords(RigWithDelays(Scattered()), kOwnDelays);
  const EffectFit base = FitBase(records);
  EXPECT_LT(LargestGain(records, AmplitudeDependentDelay(), base), 5.0);
  EXPECT_LT(LargestGain(records, DelayVariesWithPhi(), base), 5.0);
}

// A line goes through any two points.
TEST(DelayScatter, TwoDelaysThatDifferAreNoLaw) {
  const std::vector<CutRecord> records =
      MakeCutRecords(RigWithDelays({std::exp(0.02), std::exp(-0.02)}), kOwnDelays);
  const EffectFit base = FitBase(records);
  const EffectFit law = FitEffect(records, DelayVariesWithPhi()[0], base);
  EXPECT_GT(base.cost() - law.cost(), 8.0);
  EXPECT_LT(GainOver(base, law), 3.0);
}

// ... so that where no scope is stated, two operating points with two delays accuse nothing.
TEST(DelayScatter, WhereNoScopeIsStatedTwoDelaysAccuseNothing) {
  DiagnosisOptions options;
  options.withheld = AllBut({"delay_varies_with_phi", "channel_skew"});
  options.choose_delays = true;
  const Diagnosis diagnosis = Diagnose(RigWithDelays({std::exp(0.02), std::exp(-0.02)}), options);
  EXPECT_EQ(diagnosis.kind, VerdictKind::kNone) << diagnosis.effect;
  EXPECT_TRUE(diagnosis.model.own_delays);
  EXPECT_GT(diagnosis.own_delays_gain, 100.0);
}

// Over six a law is the better word than six delays.
TEST(LongDelayScatter, WhereNoScopeIsStatedALawOfSixDelaysIsNamed) {
  DiagnosisOptions options;
  options.withheld = AllBut({"delay_varies_with_phi", "channel_skew"});
  options.choose_delays = true;
  std::vector<double> factors;
  for (int point = 0; point < 6; ++point) factors.push_back(1.0 - 0.12 * (point / 5.0 - 0.5));
  const Diagnosis diagnosis = Diagnose(RigWithDelays(factors), options);
  EXPECT_EQ(diagnosis.effect, "delay_varies_with_phi");
}

TEST(DelayScatter, AnEffectThatLeavesTheFlameAloneDoesNotTakeOffTheDelaysCost) {
  const std::vector<CutRecord> records = MakeCutRecords(RigWithDelays(Scattered()), kOwnDelays);
  const EffectFit base = FitBase(records);
  const EffectFit fit = FitEffect(records, ExtraAcousticMode()[0], base);
  EXPECT_GT(base.delay_cost, 10.0);
  EXPECT_EQ(fit.delay_cost, base.delay_cost);
}

TEST(DelayScatter, DelaysThatFollowPhiAreAccusedByTheirLaw) {
  std::vector<double> factors;
  for (int point = 0; point < 6; ++point) factors.push_back(1.0 - 0.12 * (point / 5.0 - 0.5));
  const std::vector<CutRecord> records = MakeCutRecords(RigWithDelays(factors), kOwnDelays);
  const EffectFit base = FitBase(records);
  const EffectFit law = FitEffect(records, DelayVariesWithPhi()[0], base);
  EXPECT_GT(GainOver(base, law), 16.0);
  EXPECT_LT(law.delay_scatter, 2e-3);
}

TEST(LongDelayScatter, AnEffectGivenScatteringDelaysIsNamed) {
  const EffectPointer effect = QSensorLowPass()[0];
  const std::vector<double> cutoff_hz = {245.0};
  std::size_t next = 0;
  const std::vector<DiagnosisExperiment> rig = SimulatePoints(
      4,
      [&](RigParameters* point) {
        point->model.loop.tau_s *= std::exp(kOff[next++]);
        effect->AddTo({}, cutoff_hz, point);
      },
      22);
  const Diagnosis diagnosis = DiagnoseDelays(rig);
  EXPECT_EQ(diagnosis.effect, "q_sensor_lowpass");
  EXPECT_NEAR(diagnosis.delay_scatter, 0.025, 5e-3);
}

// Of four experiments an effect of one parameter pays two: one of them for tau, which is not
// theirs.
TEST(DelayScatter, FreedomThatTheEffectCostsItselfIsNotItsMerit) {
  EXPECT_DOUBLE_EQ(UnearnedFreedom(20.0, 0.0, 4, 1), 10.0);
  EXPECT_DOUBLE_EQ(UnearnedFreedom(20.0, 0.0, 2, 1), 20.0);
  EXPECT_DOUBLE_EQ(UnearnedFreedom(20.0, 0.0, 2, 2), 20.0);
  EXPECT_EQ(UnearnedFreedom(20.0, 21.0, 4, 1), 0.0);
}

}  // namespace
}  // namespace howl::delay_scatter_test
