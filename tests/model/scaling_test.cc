// The same loop run slower or faster and recorded in other units: nothing may know a frequency, a
// time or an amplitude of its own. Times scale by 1 / a, p by b and q by c, so that
//
//   omega -> a omega,  tau -> tau / a,  N, M -> N a b / c,  slope -> slope c / (a b)
//
// Powers of two change no digit, so that there the answers are asked to be the same bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/cycles/continuation.h"
#include "model/cycles/floquet.h"
#include "model/cycles/harmonic_balance.h"
#include "model/cycles/prediction.h"
#include "model/loop/crossings.h"
#include "model/loop/poles.h"
#include "model/simulation/simulate.h"
#include "tests/model/paper_loop.h"

namespace howl::scaling_test {
namespace {

struct Units {
  double a = 1.0;  // of rates
  double b = 1.0;  // of p
  double c = 1.0;  // of q
};

// From 0.8 Hz to 110 kHz, and from 1e-6 to 1e6 in p and q.
std::vector<Units> PowersOfTwo() {
  return {{std::exp2(-8), 1.0, 1.0},
          {std::exp2(9), 1.0, 1.0},
          {1.0, std::exp2(-20), std::exp2(20)},
          {1.0, std::exp2(20), std::exp2(-20)},
          {std::exp2(5), std::exp2(20), std::exp2(20)},
          {std::exp2(-3), std::exp2(-20), std::exp2(-20)}};
}

ClosedLoop Scaled(ClosedLoop model, const Units& u) {
  Acoustics<double>& acoustics = model.loop.acoustics;
  acoustics.omega_hz *= u.a;
  acoustics.N *= u.a * u.b / u.c;
  acoustics.M *= u.a * u.b / u.c;
  model.loop.tau_s /= u.a;
  model.flame.slope *= u.c / (u.a * u.b);
  model.flame.saturation *= u.c;
  return model;
}

// The growth rates that were wrong above 2 kHz: of the published loop at every decade.
TEST(Scaling, GrowthRatesOfALoopAtAnyFrequency) {
  const ClosedLoop model = PaperLoop(0.415);
  const Pole of_the_paper = *RightmostPole(model.loop, model.flame.slope);
  const PoleSet all = ClosedLoopPoles(model.loop, model.flame.slope);
  ASSERT_TRUE(all.complete);
  EXPECT_GT(of_the_paper.growth_rate, 0.0);
  for (const double omega_hz : {1.0, 20.0, 215.0, 1990.0, 2010.0, 5000.0, 1e5}) {
    const Units units{omega_hz / 215.0, 1e-6, 1e6};
    const ClosedLoop scaled = Scaled(model, units);
    const Pole pole = *RightmostPole(scaled.loop, scaled.flame.slope);
    EXPECT_NEAR(pole.growth_rate / units.a, of_the_paper.growth_rate, 1e-8) << omega_hz;
    EXPECT_NEAR(pole.frequency_hz / units.a, of_the_paper.frequency_hz, 1e-8) << omega_hz;
    const PoleSet set = ClosedLoopPoles(scaled.loop, scaled.flame.slope);
    EXPECT_TRUE(set.complete) << omega_hz;
    EXPECT_EQ(set.poles.size(), all.poles.size()) << omega_hz;
  }
}

TEST(Scaling, PolesCrossingsAndMarginsBitForBit) {
  const ClosedLoop model = PaperLoop(0.415);
  const LoopPrediction expected = PredictLoop(model, 4.2);
  ASSERT_FALSE(expected.poles.poles.empty());
  ASSERT_FALSE(expected.crossings.empty());
  ASSERT_FALSE(expected.cycles.empty());
  for (const Units& u : PowersOfTwo()) {
    const LoopPrediction got = PredictLoop(Scaled(model, u), 4.2);
    ASSERT_EQ(got.poles.poles.size(), expected.poles.poles.size());
    for (std::size_t k = 0; k < got.poles.poles.size(); ++k) {
      EXPECT_EQ(got.poles.poles[k].growth_rate / u.a, expected.poles.poles[k].growth_rate);
      EXPECT_EQ(got.poles.poles[k].frequency_hz / u.a, expected.poles.poles[k].frequency_hz);
    }
    ASSERT_EQ(got.crossings.size(), expected.crossings.size());
    for (std::size_t k = 0; k < got.crossings.size(); ++k) {
      EXPECT_EQ(got.crossings[k].frequency_hz / u.a, expected.crossings[k].frequency_hz);
      EXPECT_EQ(got.crossings[k].gain, expected.crossings[k].gain);
    }
    EXPECT_EQ(got.margins.gain_margin_db, expected.margins.gain_margin_db);
    EXPECT_EQ(got.margins.delay_margin_s * u.a, expected.margins.delay_margin_s);
    ASSERT_EQ(got.cycles.size(), expected.cycles.size());
    for (std::size_t k = 0; k < got.cycles.size(); ++k) {
      const LimitCycle& cycle = got.cycles[k].cycle;
      const LimitCycle& other = expected.cycles[k].cycle;
      EXPECT_NEAR(cycle.frequency_hz / u.a / other.frequency_hz, 1.0, 1e-12);
      EXPECT_NEAR(cycle.pressure_amplitude() / u.b / other.pressure_amplitude(), 1.0, 1e-12);
      EXPECT_NEAR(cycle.heat_release_amplitude() / u.c / other.heat_release_amplitude(), 1.0,
                  1e-12);
      EXPECT_EQ(cycle.harmonics(), other.harmonics());
      EXPECT_EQ(got.cycles[k].floquet.stable, expected.cycles[k].floquet.stable);
      EXPECT_NEAR(got.cycles[k].floquet.leading_modulus(),
                  expected.cycles[k].floquet.leading_modulus(), 1e-9);
    }
  }
}

Branch BranchOf(const Units& u) {
  ContinuationOptions options;
  options.parameter_min = 0.3;
  options.parameter_max = 0.6;
  options.stability = false;
  const auto cycles = LimitCycles(Scaled(PaperLoop(0.415), u), 4.2 * 215.0 * u.a);
  return ContinueCycle([&](double r) { return Scaled(PaperLoop(r), u); }, 0.415, cycles.at(0),
                       options);
}

TEST(Scaling, ContinuationTakesTheSameSteps) {
  const Branch expected = BranchOf({});
  ASSERT_GT(expected.points.size(), 3u);
  for (const Units& u : PowersOfTwo()) {
    const Branch got = BranchOf(u);
    ASSERT_EQ(got.points.size(), expected.points.size()) << u.a;
    for (std::size_t k = 0; k < got.points.size(); ++k) {
      EXPECT_NEAR(got.points[k].parameter, expected.points[k].parameter, 1e-9);
      EXPECT_NEAR(got.points[k].cycle.frequency_hz / u.a, expected.points[k].cycle.frequency_hz,
                  1e-6);
    }
  }
}

// With noise in the flame and in the sensors: the time step follows the cycle and the delay.
TEST(Scaling, SimulationBitForBit) {
  const auto run = [](const Units& u) {
    SimulationCase one;
    one.rig.model = Scaled(PaperLoop(0.415), u);
    one.rig.noise.combustion_corner_hz = 500.0 * u.a;
    one.rig.noise.combustion_density = 1e-7 * u.c * u.c / u.a;
    one.rig.noise.pressure_sensor_std = 1e-3 * u.b;
    one.rig.past = {{0.1 * u.c, 215.0 * u.a, 0.0, 0.3}};
    one.seed = 5;
    return Simulate(one, {.duration_s = 0.2 / u.a, .sampling_hz = 5000.0 * u.a, .threads = 1});
  };
  const SimulatedRecord expected = run({});
  for (const Units& u : PowersOfTwo()) {
    const SimulatedRecord got = run(u);
    ASSERT_EQ(got.pressure.size(), expected.pressure.size());
    std::size_t different = 0;
    for (std::size_t k = 0; k < got.pressure.size(); ++k) {
      different += got.pressure[k] / u.b != expected.pressure[k] ||
                   got.heat_release[k] / u.c != expected.heat_release[k];
    }
    EXPECT_EQ(different, 0u) << u.a << " " << u.b << " " << u.c;
  }
}

}  // namespace
}  // namespace howl::scaling_test
