// The loop gain at rest on simulated rigs as noisy as a turbulent combustor's, and why it may lie
// below one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "estimation/analysis/analyse.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "model/cycles/harmonic_balance.h"
#include "model/numerics/units.h"
#include "model/simulation/simulate.h"

namespace howl::loop_gain_test {
namespace {

// One mode at 110 Hz with the gain 1.2 and the phase 45 degrees of q to p, as at the points p14 to
// p19 of the combustor, by (5c) at xi = 0.08. `noise`: rms of the combustion noise over the cycle's
// amplitude of q; 0.5 and 1 make the cycle's line 0.2 and 0.8 Hz wide, as there.
RigParameters CombustorLikeRig(double loop_gain, double noise) {
  constexpr double kFrequencyHz = 110.0, kGain = 1.2, kXi = 0.08;
  const double phase = 45.0 * kRadPerDeg;
  const double t = std::tan(-phase);
  const double omega_hz = kFrequencyHz * (std::sqrt(kXi * kXi * t * t + 1.0) - kXi * t);
  const double n = kGain * 2.0 * kXi * kRadPerSPerHz * omega_hz / std::cos(phase);
  const LoopParameters<double> loop{{omega_hz, kXi, n, 0.0, 3.0},
                                    (270.0 + 45.0) / (360.0 * kFrequencyHz)};
  RigParameters rig;
  const double slope = -loop_gain / Magnitude(LoopResponse(loop, kFrequencyHz));
  rig.model = {loop, {FlameShape::kTanh, slope, 0.2, 0.0}};
  const LimitCycle cycle = LimitCycles(rig.model, 300.0).front();
  const double std = noise * cycle.heat_release_amplitude();
  rig.noise.combustion_corner_hz = 500.0;
  rig.noise.combustion_density = 2.0 * std * std / (std::numbers::pi * 500.0);
  rig.noise.pressure_sensor_std = 0.01 * cycle.pressure_amplitude();
  rig.noise.heat_release_sensor_std = 0.01 * cycle.heat_release_amplitude();
  rig.past = PastOnCycle(cycle);
  return rig;
}

// The pressure beside the line is the loop's own, which the flame felt: taken for noise of the p
// sensor it would take a tenth off the slope.
TEST(LoopGain, OfRigsAsNoisyAsACombustorIsUnbiasedAndCovered) {
  constexpr int kSeeds = 10;
  int covered = 0, count = 0;
  for (const double loop_gain : {1.1, 1.3}) {
    for (const double noise : {0.2, 0.5, 1.0}) {
      const RigParameters rig = CombustorLikeRig(loop_gain, noise);
      std::vector<SimulationCase> cases;
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) cases.push_back({rig, seed});
      double mean = 0.0;
      int found = 0;
      for (const SimulatedRecord& one :
           SimulateBatch(cases, {.duration_s = 3.0, .sampling_hz = 10000.0, .settle_s = 1.0})) {
        const NamedRecord record{"rig", 0.5, ToRecord(one)};
        const Analysis analysis = AnalyseRecords(std::span(&record, 1)).analyses.front();
        if (!analysis.flame_curve) continue;
        const Estimate& slope = analysis.flame_curve->slope;
        const double truth = rig.model.flame.slope;
        mean += slope.value / truth;
        ++found;
        ++count;
        covered += std::abs(slope.value - truth) <= kNormal95 * slope.std ? 1 : 0;
      }
      ASSERT_GE(found, kSeeds - 2);
      EXPECT_NEAR(mean / found, 1.0, 0.1) << loop_gain << " " << noise;
    }
  }
  EXPECT_GE(covered, 0.9 * count) << "of " << count;
}

// Mean cycles of known harmonics: r_3 and r_5 of a hyperbolic sine, which is steeper in the cycle
// than at rest (the modified Bessel functions I_3 / I_1 and I_5 / I_1 at 1: 0.0392 and 0.00048), so
// that Phi'(0) / D = 1 / (2 I_1(1)) = 0.8846.
TEST(LoopGain, BelowOneHasAReason) {
  Characteristics cycle;
  cycle.state = CycleState::kLimitCycle;
  FlameCurve curve;
  curve.mean_cycle = {1.0, 0.0, 0.03922, 0.0, 0.00048};
  const Estimate low{0.885, 0.02};
  const auto steeper = ExplainLowLoopGain(cycle, curve, low);
  ASSERT_TRUE(steeper.has_value());
  EXPECT_EQ(steeper->reason, LoopGainReason::kSteeperInCycle);
  EXPECT_NEAR(steeper->shape_gain, 0.8846, 1e-3);
  EXPECT_GT(steeper->stiffening, 0.0);

  curve.mean_cycle[2] = std::polar(0.06, 1.3);
  EXPECT_EQ(ExplainLowLoopGain(cycle, curve, low)->reason, LoopGainReason::kMemory);
  curve.mean_cycle[2] = 0.0;
  EXPECT_EQ(ExplainLowLoopGain(cycle, curve, low)->reason, LoopGainReason::kNotExplained);
  curve.regressor_noise = 0.1;
  EXPECT_EQ(ExplainLowLoopGain(cycle, curve, low)->reason, LoopGainReason::kNoise);

  EXPECT_FALSE(ExplainLowLoopGain(cycle, curve, {0.885, 0.1}).has_value());
  cycle.state = CycleState::kIntermittent;
  EXPECT_FALSE(ExplainLowLoopGain(cycle, curve, low).has_value());
}

}  // namespace
}  // namespace howl::loop_gain_test
