// What the halves of records tell of the intervals.
#include "estimation/joint_records/interval_scale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "estimation/analysis/spectra/half_width.h"
#include "estimation/joint_records/choose_loop.h"
#include "tests/estimation/record_fit/modal_loop.h"

namespace howl::interval_scale_test {
namespace {

FittedLoop LoopWith(const Estimate& tau_s, const Estimate& gain, const Estimate& omega_hz) {
  FittedLoop out;
  out.tau_s = tau_s;
  out.small_signal.loop_gain = gain;
  out.modes.push_back({omega_hz, {0.1, 0.01}, {1.0, 0.1}, {0.0, 0.0}});
  return out;
}

const IntervalScale* Find(const std::vector<IntervalScale>& scales, const std::string& quantity) {
  const auto at = std::ranges::find(scales, quantity, &IntervalScale::quantity);
  return at == scales.end() ? nullptr : &*at;
}

TEST(IntervalScale, IsTheMeanSquareDifferenceOverItsVariance) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  // Of tau: differences of 3 and of 1 deviations of the halves, and of 2 and none of the whole from
  // the halves' mean. Of the gain one point has no root in its second half.
  const std::vector<HalfLoops> halves = {{LoopWith({1.0, 0.3}, {1.0, 0.1}, {200.0, 3.0}),
                                          LoopWith({2.5, 0.4}, {1.2, 0.1}, {200.0, 4.0})},
                                         {LoopWith({1.0, 0.3}, {1.0, 0.1}, {200.0, 3.0}),
                                          LoopWith({1.5, 0.4}, {kNone, kNone}, {201.0, 4.0})}};
  const auto mean = [](double a, double b) {
    return (a / 0.09 + b / 0.16) / (1 / 0.09 + 1 / 0.16);
  };
  const std::vector<FittedLoop> wholes = {
      LoopWith({mean(1.0, 2.5) + 0.4, 0.2}, {1.1, 0.1}, {200.0, 2.0}),
      LoopWith({mean(1.0, 1.5), 0.2}, {1.0, 0.1}, {200.0 + 9.0 / 25.0, 2.0})};
  const std::vector<IntervalScale> scales = ScalesOf(wholes, halves);
  const IntervalScale* const tau = Find(scales, "tau_s");
  ASSERT_NE(tau, nullptr);
  EXPECT_NEAR(tau->halves, std::sqrt((9.0 + 4.0 + 1.0) / 2.0), 1e-12);
  EXPECT_EQ(tau->points, 2u);
  EXPECT_EQ(tau->worst, 0u);
  const IntervalScale* const gain = Find(scales, "small_signal.loop_gain");
  ASSERT_NE(gain, nullptr);
  EXPECT_NEAR(gain->halves, 0.2 / std::hypot(0.1, 0.1), 1e-12);
  EXPECT_EQ(gain->points, 1u);
  const IntervalScale* const omega = Find(scales, "modes.0.omega_hz");
  ASSERT_NE(omega, nullptr);
  EXPECT_NEAR(omega->halves, std::sqrt(0.5) / 5.0, 1e-9);
  EXPECT_EQ(omega->worst, 1u);
  // What has no error has no scale.
  EXPECT_EQ(Find(scales, "modes.0.B"), nullptr);

  std::vector<FittedLoop> loops = {LoopWith({1.0, 0.1}, {1.0, 0.1}, {200.0, 2.0})};
  Widen(scales, &loops);
  EXPECT_NEAR(loops[0].tau_s.std, 0.1 * std::sqrt(7.0), 1e-12);
  EXPECT_NEAR(loops[0].small_signal.loop_gain.std, 0.1 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(loops[0].modes[0].omega_hz.std, 2.0);  // halves that agree make nothing narrower
  EXPECT_EQ(loops[0].modes[0].B.std, 0.0);
}

// Of a duct whose delay is longer in the second half of each record by this share.
struct Drifting {
  explicit Drifting(double drift) {
    std::vector<LoopRecord> records;
    for (const double gain : {1.2, 1.5, 1.8}) {
      ModalLoop loop = DuctOfModes(2);
      tau_s = loop.tau_s;
      const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
      loop.slope = gain / loop.Open(cycle_hz).real();
      loop.drift = drift;
      records.push_back({"", gain, cycle_hz, SimulateModalLoop(loop, 1.2, records.size() + 1)});
    }
    RecordsFitOptions options;
    options.starts = 2;
    const ChosenLoop loop = FitLoop(records, RecordLoopSpec{}, options);
    halves = LoopsOfHalves(records, loop.points, loop.fit.structure, loop.halves);
    for (std::size_t e = 0; e < records.size(); ++e) {
      fitted.push_back(FittedLoopOf(loop.points[e].record, loop.fit.structure, loop.fit.points[e]));
    }
  }

  std::vector<IntervalScale> Scales() const { return ScalesOf(fitted, halves); }

  double tau_s = 0.0;  // in the middle
  std::vector<HalfLoops> halves;
  std::vector<FittedLoop> fitted;
};

// The mean square of three differences is chi-squared over three: above 2.3 once in a thousand.
TEST(IntervalScale, IsOneButForChanceWhereTheModelIsRight) {
  const std::vector<IntervalScale> scales = Drifting(0.0).Scales();
  for (const char* const quantity :
       {"tau_s", "small_signal.loop_gain", "small_signal.growth_rate_1_s",
        "small_signal.frequency_hz", "modes.0.omega_hz", "modes.0.xi", "modes.1.omega_hz"}) {
    const IntervalScale* const scale = Find(scales, quantity);
    ASSERT_NE(scale, nullptr) << quantity;
    EXPECT_EQ(scale->points, 3u) << quantity;
    EXPECT_LT(scale->halves, 2.3) << quantity;
    EXPECT_GT(scale->halves, 0.05) << quantity;
  }
}

// Half way between two states there is none, and the plain intervals are about what the fit makes
// of both, next to the middle or not: they are too narrow to hold both.
TEST(LongIntervalScale, IntervalsOfARigThatChangesHoldItsMiddle) {
  constexpr double kDrift = 0.06;
  Drifting rig(kDrift);
  const std::vector<IntervalScale> scales = rig.Scales();
  const IntervalScale* const tau = Find(scales, "tau_s");
  ASSERT_NE(tau, nullptr);
  EXPECT_GT(tau->halves, 3.0);
  const std::vector<FittedLoop> plain = rig.fitted;
  Widen(scales, &rig.fitted);
  for (const FittedLoop& loop : plain) {
    EXPECT_LT(2.0 * HalfWidth95(loop.tau_s), kDrift * rig.tau_s);
  }
  for (const FittedLoop& loop : rig.fitted) {
    EXPECT_LT(std::abs(loop.tau_s.value - rig.tau_s), HalfWidth95(loop.tau_s));
  }
  for (const HalfLoops& halves : rig.halves) {
    EXPECT_LT(halves[0].tau_s.value, rig.tau_s);
    EXPECT_GT(halves[1].tau_s.value, rig.tau_s);
  }
}

}  // namespace
}  // namespace howl::interval_scale_test
