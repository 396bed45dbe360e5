// The table of a flame: what a monotone cubic keeps, and the flame that it makes in the loop.
#include "model/loop/flame_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/cycles/harmonic_balance.h"
#include "model/simulation/simulate.h"
#include "tests/model/paper_loop.h"

namespace howl::flame_table_test {
namespace {

TEST(FlameTable, PassesThroughItsPointsAndNeverOvershoots) {
  const std::vector<double> u = {-3.0, -1.0, -0.5, 0.0, 0.2, 2.0, 5.0};
  const std::vector<double> q = {-1.0, -1.0, -0.4, 0.0, 0.3, 0.9, 1.1};
  const FlameTable table(u, q);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_DOUBLE_EQ(table.Value(u[i]), q[i]);
  double previous = -2.0;
  for (double x = -4.0; x < 6.0; x += 0.01) {
    const double value = table.Value(x);
    EXPECT_GE(value, previous - 1e-14) << x;
    previous = value;
    if (x < -3.01 || x > 5.01) continue;
    const double h = 1e-6;
    EXPECT_NEAR(table.Slope(x), (table.Value(x + h) - table.Value(x - h)) / (2.0 * h), 1e-4) << x;
  }
  EXPECT_EQ(table.Value(-100.0), -1.0);
  EXPECT_EQ(table.Value(100.0), 1.1);
}

// tanh in 200 points: between them the cubic misses it by less than a millionth.
FlameTable TableOfTanh(double saturation) {
  std::vector<double> u, q;
  for (int i = -200; i <= 200; ++i) {
    u.push_back(0.04 * i * saturation);
    q.push_back(saturation * std::tanh(0.04 * i));
  }
  return {u, q};
}

TEST(FlameTable, OfTanhIsTanh) {
  const FlameTable table = TableOfTanh(0.5);
  for (double u = -3.0; u < 3.0; u += 0.0137) {
    EXPECT_NEAR(table.Value(u), 0.5 * std::tanh(u / 0.5), 2e-5) << u;
  }
  EXPECT_NEAR(table.Slope(0.0), 1.0, 1e-3);
}

// The loop with the table has the cycle of the loop with tanh, by harmonic balance.
TEST(FlameTable, HasTheCycleOfItsShape) {
  const ClosedLoop model = PaperLoop(0.0);
  const std::vector<LimitCycle> cycles = LimitCycles(model, 500.0);
  ASSERT_EQ(cycles.size(), 1U);
  SimulationCase one;
  one.rig.model = model;
  one.rig.model.flame = {FlameShape::kLinear, model.flame.slope, 1.0, 0.0};
  one.rig.effects.push_back(MakeTableEffect(TableOfTanh(model.flame.saturation)));
  one.rig.past = PastOnCycle(cycles[0]);
  SimulationOptions options;
  options.duration_s = 1.0;
  options.settle_s = 1.0;
  const SimulatedRecord record = Simulate(one, options);
  double square = 0.0;
  for (const double p : record.pressure) square += p * p;
  const double rms = std::sqrt(square / static_cast<double>(record.pressure.size()));
  double expected = 0.0;
  for (const auto& p : cycles[0].pressure) expected += 0.5 * std::norm(p);
  EXPECT_NEAR(rms / std::sqrt(expected), 1.0, 1e-3);
}

}  // namespace
}  // namespace howl::flame_table_test
