#include "estimation/analysis/flame/flame_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "estimation/analysis/analyse.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "model/cycles/harmonic_balance.h"
#include "model/simulation/simulate.h"

namespace howl::flame_curve_test {
namespace {

// Two modes, so that p has a third harmonic that the flame feels.
RigParameters TwoModeRig(double loop_gain, double noise) {
  RigParameters rig;
  const LoopParameters<double> loop{{215.0, 0.2, 6609.0, 0.415 * 6609.0, 3.0}, 3.46e-3};
  const double slope = -loop_gain / Magnitude(LoopResponse(loop, 218.0));
  rig.model = {loop, {FlameShape::kTanh, slope, 1.0, 0.0}};
  rig.noise.combustion_corner_hz = 500.0;
  rig.noise.combustion_density = 2.0 * noise * noise / (std::numbers::pi * 500.0);
  rig.past = PastOnCycle(LimitCycles(rig.model, 400.0).front());
  return rig;
}

Analysis AnalyseRig(const RigParameters& rig, std::uint64_t seed, int max_harmonic) {
  const SimulatedRecord record =
      Simulate({rig, seed}, {.duration_s = 3.2, .sampling_hz = 5000.0, .settle_s = 0.5});
  AnalysisOptions options;
  options.flame_curve.max_harmonic = max_harmonic;
  const NamedRecord named{"rig", 0.5, ToRecord(record)};
  return AnalyseRecords(std::span(&named, 1), options).analyses.front();
}

TEST(FlameCurve, HarmonicsOfPressureBelongToTheDerivativeThatTheFlameFeels) {
  const RigParameters rig = TwoModeRig(1.18, 0.01);
  const double truth = rig.model.flame.slope;
  const FlameCurve with = *AnalyseRig(rig, 1, 5).flame_curve;
  const FlameCurve without = *AnalyseRig(rig, 1, 1).flame_curve;
  EXPECT_GE(with.harmonics, 1);
  EXPECT_EQ(without.harmonics, 0);
  EXPECT_NEAR(with.slope.value / truth, 1.0, 0.01);
  // (4) as it stands misses the third harmonic's part of the slope at zero.
  EXPECT_GT(std::abs(without.slope.value / truth - 1.0), 0.04);
}

TEST(FlameCurve, SlopeOfNoisyRigsLiesWithinItsInterval) {
  int covered = 0;
  int count = 0;
  for (const double loop_gain : {1.1, 1.2, 1.35}) {
    const RigParameters rig = TwoModeRig(loop_gain, 0.05);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Estimate slope = AnalyseRig(rig, seed, 5).flame_curve->slope;
      const double error = slope.value / rig.model.flame.slope - 1.0;
      EXPECT_LT(std::abs(error), 0.1);
      ++count;
      // The polynomial's own error, about a hundredth, is no part of the interval.
      const double bound = kNormal95 * slope.std / std::abs(slope.value) + 0.01;
      covered += std::abs(error) <= bound ? 1 : 0;
    }
  }
  EXPECT_GE(covered, count * 8 / 10) << "of " << count;
}

}  // namespace
}  // namespace howl::flame_curve_test
