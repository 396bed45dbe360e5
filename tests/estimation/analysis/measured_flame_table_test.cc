// The table of a flame whose curve is known: q = -s S tanh(x / S).
#include "estimation/analysis/flame/measured_flame_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimation/analysis/analyse.h"
#include "tests/estimation/analysis/synthetic_record.h"

namespace howl::measured_flame_table_test {
namespace {

TEST(MeasuredFlameTable, IsTheCurveOfTheRecord) {
  fixtures::SyntheticOptions options;
  options.loop_gain = 1.6;
  options.noise = 0.02;
  options.q_offset = 3.0;
  const fixtures::SyntheticRecord truth = fixtures::Synthesise(options, 11);
  Analysis analysis = AnalyseRecord(truth.record);
  AddFlame(truth.record, {truth.tau_s, 0.0}, {}, &analysis);
  ASSERT_TRUE(analysis.flame_curve);
  const auto table = MeasuredFlameTable(*analysis.flame_curve, truth.flame_slope);
  ASSERT_TRUE(table);
  const double w = 2.0 * M_PI * options.frequency_hz;
  const double drive = fixtures::DriveOverScale(options.loop_gain);
  const double scale = w * options.p_amplitude / drive;           // S
  const double saturation = std::abs(truth.flame_slope) * scale;  // s S
  for (double over_scale = -0.95 * drive; over_scale < 0.95 * drive; over_scale += 0.07) {
    EXPECT_NEAR(table->Value(saturation * over_scale), saturation * std::tanh(over_scale),
                0.02 * saturation)
        << over_scale;
  }
}

TEST(MeasuredFlameTable, NeedsBinsAndAFallingCurve) {
  FlameCurve curve;
  EXPECT_FALSE(MeasuredFlameTable(curve, -1.0));
  for (int i = -5; i <= 5; ++i) curve.bins.push_back({0.1 * i, -0.1 * i, 0.01, 10});
  EXPECT_TRUE(MeasuredFlameTable(curve, -1.0));
  EXPECT_FALSE(MeasuredFlameTable(curve, 1.0));
  // A dip is levelled with its neighbours, by their weights: 0.2 and 0.1 of equal weight.
  curve.bins[3].q = 0.1;  // x = -0.2
  curve.bins[4].q = 0.2;  // x = -0.1
  const auto table = MeasuredFlameTable(curve, -1.0);
  EXPECT_NEAR(table->Value(0.1), 0.15, 1e-12);
  EXPECT_NEAR(table->Value(0.2), 0.15, 1e-12);
}

}  // namespace
}  // namespace howl::measured_flame_table_test
