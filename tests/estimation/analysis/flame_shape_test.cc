#include "estimation/analysis/flame/flame_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "estimation/analysis/analyse.h"
#include "estimation/analysis/flame/flame_bin_residual.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "model/cycles/harmonic_balance.h"
#include "model/loop/flame_shapes.h"
#include "model/simulation/simulate.h"
#include "tests/residual_jacobian.h"

namespace howl::flame_shape_test {
namespace {

// The curve that a flame without noise would show: exact values of Phi in 40 bins.
FlameCurve ExactCurve(const Flame<double>& flame, double v_amplitude, double mean) {
  FlameCurve curve;
  curve.x_amplitude = v_amplitude;
  for (int i = 0; i < 40; ++i) {
    const double v = v_amplitude * (2.0 * (i + 0.5) / 40.0 - 1.0);
    curve.bins.push_back({v, mean + FlameResponse(flame, v), 0.001, 100});
  }
  curve.saturation_low = curve.bins.back().q;
  curve.saturation_high = curve.bins.front().q;
  return curve;
}

TEST(FlameShape, ResidualsJacobianIsCorrect) {
  for (const FlameShape shape : kFlameShapes) {
    for (const double v : {-9000.0, -2000.0, 500.0, 7000.0}) {
      const std::unique_ptr<ceres::CostFunction> cost(
          FlameBinResidual::Create({shape, -2e-4, v, 0.3, 0.05}));
      EXPECT_TRUE(JacobianIsCorrect(*cost, {std::log(0.8), 0.21, 0.4}))
          << static_cast<int>(shape) << " " << v;
    }
  }
}

TEST(FlameShape, EachShapeIsFoundWithItsSaturationOffsetAndMean) {
  for (const FlameShape shape : kFlameShapes) {
    for (const double relative_offset : {-0.3, 0.0, 0.4}) {
      FlameShapeFit truth;
      truth.shape = shape;
      truth.saturation = 0.7;
      truth.relative_offset = relative_offset;
      const Flame<double> flame = truth.WithSlopeAtRest(-2e-4);
      EXPECT_NEAR(FlameSlope(flame, 0.0), -2e-4, 1e-15);
      const auto fit = FitFlameShape(ExactCurve(flame, 9000.0, 12.0), -2e-4);
      ASSERT_TRUE(fit.has_value());
      EXPECT_EQ(fit->shape, shape) << relative_offset;
      EXPECT_NEAR(fit->saturation, 0.7, 1e-5);
      EXPECT_NEAR(fit->relative_offset, relative_offset, 1e-5);
      EXPECT_NEAR(fit->mean, 12.0, 1e-5);
      EXPECT_LT(fit->chi_square, 1e-3);
    }
  }
}

TEST(FlameShape, WithoutASlopeOrABinThereIsNone) {
  const FlameCurve curve = ExactCurve({FlameShape::kTanh, -2e-4, 0.7, 0.0}, 9000.0, 0.0);
  EXPECT_FALSE(FitFlameShape(curve, 0.0).has_value());
  EXPECT_FALSE(FitFlameShape(curve, 1e-4).has_value());
  EXPECT_FALSE(FitFlameShape({}, -2e-4).has_value());
}

// From a noisy record the refitted flame closes the loop at the recorded cycle's amplitude: what a
// simulation with it is for. By the describing function; 3 % of the amplitude is what the noise of
// the slope, about 1 % in a loop gain of 1.3, moves it by.
TEST(FlameShape, AnOffsetRigsRecordGivesAFlameOfTheSameCycle) {
  const LoopParameters<double> loop{{215.0, 0.1, 2000.0, 0.0, 3.0}, 3.46e-3};
  const double frequency_hz = 217.0;
  FlameShapeFit truth;
  truth.shape = FlameShape::kArctan;
  truth.saturation = 0.6;
  truth.relative_offset = 0.4;
  RigParameters rig;
  const double slope = -1.3 / Magnitude(LoopResponse(loop, frequency_hz));
  rig.model = {loop, truth.WithSlopeAtRest(slope)};
  rig.noise.combustion_corner_hz = 500.0;
  rig.noise.combustion_density = 2.0 * 0.01 * 0.01 / (std::numbers::pi * 500.0);
  const LimitCycle cycle = LimitCycles(rig.model, 400.0).front();
  rig.past = PastOnCycle(cycle);
  const SimulatedRecord record =
      Simulate({rig, 7}, {.duration_s = 3.2, .sampling_hz = 5000.0, .settle_s = 0.5});
  const NamedRecord named{"rig", 0.5, ToRecord(record)};
  const Analysis analysis = AnalyseRecords(std::span(&named, 1)).analyses.front();
  ASSERT_TRUE(analysis.flame_curve.has_value());
  const auto fit = FitFlameShape(*analysis.flame_curve, analysis.flame_curve->slope.value);
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(std::abs(fit->relative_offset), 0.4, 0.1);
  const Flame<double> flame = fit->WithSlopeAtRest(analysis.flame_curve->slope.value);
  const double amplitude = cycle.rate_amplitude();
  EXPECT_NEAR(DescribingFunction(flame, amplitude) / DescribingFunction(rig.model.flame, amplitude),
              1.0, 0.03);
}

}  // namespace
}  // namespace howl::flame_shape_test
