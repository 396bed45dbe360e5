// A sweep there and back in one run: where it jumps, against the branches of cycles.
#include "model/simulation/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/model/paper_loop.h"

namespace howl::sweep_test {
namespace {

constexpr double kFrom = 0.50;
constexpr double kTo = 1.05;

SimulationCase OnTheLowerCycle() {
  SimulationCase one;
  one.rig.model = PaperLoop(kFrom);
  one.rig.noise.combustion_density = 1e-9;  // enough to leave a cycle that no longer attracts
  one.rig.noise.combustion_corner_hz = 1500.0;
  one.rig.past = PastOnCycle(LimitCycles(one.rig.model, 300.0).at(0));
  one.seed = 5;
  return one;
}

TEST(Sweep, JumpsWhereTheBranchesEnd) {
  const SweepOptions options{.from = kFrom, .to = kTo, .one_way_s = 60.0, .steps = 55};
  const std::vector<SweepWindow> windows =
      SweepInTime(OnTheLowerCycle(), SweptParameter::kMOverN, options);
  ASSERT_EQ(windows.size(), 110u);

  // The range in which both cycles attract, by harmonic balance and Floquet multipliers.
  ContinuationOptions limits;
  limits.parameter_min = 0.2;
  limits.parameter_max = kTo;
  const auto path = [](double ratio) { return PaperLoop(ratio); };
  const auto branch = [&](double at, std::size_t which) {
    return StableIntervals(
        ContinueCycle(path, at, LimitCycles(PaperLoop(at), 900.0).at(which), limits));
  };
  const auto both = Intersect(branch(0.415, 0), branch(0.8, 1));
  ASSERT_EQ(both.size(), 1u);
  EXPECT_NEAR(both[0].lo, 0.625, 0.001);
  EXPECT_NEAR(both[0].hi, 0.923, 0.001);

  // A jump comes no earlier than the branch ends, but for half a window; and late.
  const std::vector<SweepJump> jumps = FindJumps(windows);
  ASSERT_EQ(jumps.size(), 2u);
  constexpr double kHalfWindow = 0.5 * (kTo - kFrom) / 55;
  EXPECT_FALSE(jumps[0].back);
  EXPECT_NEAR(jumps[0].from_hz, 216.5, 1.0);
  EXPECT_NEAR(jumps[0].to_hz, 751.0, 2.0);
  EXPECT_GT(jumps[0].parameter, both[0].hi - kHalfWindow);
  EXPECT_LT(jumps[0].parameter, both[0].hi + 0.06);
  EXPECT_TRUE(jumps[1].back);
  EXPECT_NEAR(jumps[1].from_hz, 750.0, 2.0);
  EXPECT_NEAR(jumps[1].to_hz, 216.5, 1.0);
  EXPECT_LT(jumps[1].parameter, both[0].lo + kHalfWindow);
  EXPECT_GT(jumps[1].parameter, both[0].lo - 0.06);

  const std::vector<ParameterInterval> hysteresis = FindHysteresis(windows, options);
  ASSERT_EQ(hysteresis.size(), 1u);
  EXPECT_NEAR(hysteresis[0].lo, jumps[1].parameter, 2.1 * kHalfWindow);
  EXPECT_NEAR(hysteresis[0].hi, jumps[0].parameter, 2.1 * kHalfWindow);

  // Away from the jumps each window has the amplitude and frequency of the cycle by harmonic
  // balance: the sweep is slow.
  for (const SweepWindow& window : windows) {
    bool near_a_jump = false;
    for (const SweepJump& jump : jumps) {
      near_a_jump = near_a_jump || std::abs(window.parameter - jump.parameter) < 0.04;
    }
    if (near_a_jump) continue;
    const auto cycles = LimitCycles(PaperLoop(window.parameter), 900.0);
    const LimitCycle& cycle = window.frequency_hz < 400.0 ? cycles.front() : cycles.back();
    EXPECT_NEAR(window.frequency_hz / cycle.frequency_hz, 1.0, 5e-4) << window.parameter;
    EXPECT_NEAR(window.pressure_amplitude / cycle.pressure_amplitude(), 1.0, 0.01)
        << window.parameter;
  }
}

TEST(Sweep, OneCycleHasNoHysteresis) {
  // The delay from 3.3 to 3.6 ms and back: the frequency falls with it, and no jump.
  const SweepOptions options{.from = 0.0033, .to = 0.0036, .one_way_s = 5.0, .steps = 10};
  SimulationCase one = OnTheLowerCycle();
  one.rig.model = PaperLoop(0.2);
  const std::vector<SweepWindow> windows = SweepInTime(one, SweptParameter::kTau, options);
  EXPECT_TRUE(FindJumps(windows).empty());
  EXPECT_TRUE(FindHysteresis(windows, options).empty());
  for (const SweepWindow& window : windows) {
    ClosedLoop model = PaperLoop(0.2);
    model.loop.tau_s = window.parameter;
    EXPECT_NEAR(window.frequency_hz, LimitCycles(model, 300.0).at(0).frequency_hz, 0.2);
  }
  EXPECT_GT(windows[0].frequency_hz, windows[9].frequency_hz + 5.0);
}

TEST(Sweep, AtRestThereIsNoLineToJumpFrom) {
  // The flame's slope from too little for a cycle to enough: no jump from the noise's line, and
  // the cycle comes and goes at the same place.
  const SweepOptions options{.from = 0.6, .to = 1.4, .one_way_s = 20.0, .steps = 20};
  SimulationCase one = OnTheLowerCycle();
  one.rig.model = PaperLoop(0.1);
  one.rig.past.clear();
  const std::vector<SweepWindow> windows = SweepInTime(one, SweptParameter::kSlopeFactor, options);
  EXPECT_TRUE(FindJumps(windows).empty());
  for (const SweepWindow& window : windows) {
    const auto cycles = LimitCycles(
        WithParameter(PaperLoop(0.1), SweptParameter::kSlopeFactor, window.parameter), 300.0);
    if (window.parameter < 0.75) {
      EXPECT_TRUE(cycles.empty());
      EXPECT_LT(window.pressure_amplitude, 0.05) << window.parameter;
    } else if (window.parameter > 1.0) {
      ASSERT_EQ(cycles.size(), 1u);
      EXPECT_NEAR(window.pressure_amplitude / cycles[0].pressure_amplitude(), 1.0, 0.05)
          << window.parameter;
    }
  }
}

TEST(Sweep, WithParameterSetsThatParameterAlone) {
  for (const SweptParameter parameter : kSweptParameters) {
    const ClosedLoop base = PaperLoop(0.5);
    const ClosedLoop moved = WithParameter(base, parameter, 1.25);
    const auto values = [](const ClosedLoop& m) {
      const auto& a = m.loop.acoustics;
      return std::vector<double>{a.omega_hz,       a.xi,         a.N,           a.M,
                                 a.harmonic_ratio, m.loop.tau_s, m.flame.slope, m.flame.saturation};
    };
    int changed = 0;
    for (std::size_t i = 0; i < values(base).size(); ++i) {
      changed += values(base)[i] == values(moved)[i] ? 0 : 1;
    }
    EXPECT_EQ(changed, 1) << SweptParameterName(parameter);
  }
  EXPECT_DOUBLE_EQ(WithParameter(PaperLoop(0.5), SweptParameter::kMOverN, 0.9).loop.acoustics.M,
                   PaperLoop(0.9).loop.acoustics.M);
}

}  // namespace
}  // namespace howl::sweep_test
