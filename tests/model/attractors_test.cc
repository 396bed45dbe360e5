// Noise in the loop: figure 11's two lines, and switching between two cycles.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "model/cycles/floquet.h"
#include "model/cycles/harmonic_balance.h"
#include "model/numerics/constants.h"
#include "model/simulation/ramp.h"
#include "model/simulation/simulate.h"
#include "tests/model/paper_loop.h"

namespace howl::attractors_test {
namespace {

// Amplitude of the line at f in the Hann-windowed span [begin, begin + n).
double LineAmplitude(const SimulatedRecord& record, std::size_t begin, std::size_t n, double f) {
  double re = 0.0;
  double im = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double hann = 1.0 - std::cos(kTwoPi * static_cast<double>(i) / static_cast<double>(n));
    const double angle = kTwoPi * f * static_cast<double>(i) / record.sampling_hz;
    re += hann * record.pressure[begin + i] * std::cos(angle);
    im += hann * record.pressure[begin + i] * std::sin(angle);
  }
  return 2.0 * std::hypot(re, im) / static_cast<double>(n);
}

SimulatedRecord NoisyRun(double m_over_n, double density, double duration_s, std::uint64_t seed,
                         std::size_t start_cycle) {
  SimulationCase one;
  one.rig.model = PaperLoop(m_over_n);
  one.rig.noise.combustion_density = density;
  one.rig.noise.combustion_corner_hz = 1500.0;
  one.rig.past = PastOnCycle(LimitCycles(one.rig.model, 900.0).at(start_cycle));
  one.seed = seed;
  SimulationOptions options;
  options.duration_s = duration_s;
  return Simulate(one, options);
}

TEST(Attractors, Figure11TwoLines) {
  // At 5 kHz, as in the paper; ten times its 16 000 samples, for a broad line's frequency scatters.
  const SimulatedRecord record = NoisyRun(0.415, 2e-7, 32.0, 11, 0);
  ASSERT_EQ(record.pressure.size(), 160000u);
  constexpr std::size_t kSegment = 1000;
  std::vector<double> frequency;
  std::vector<double> power;
  for (double f = 100.0; f <= 1000.0; f += 5.0) {
    double sum = 0.0;
    for (std::size_t begin = 0; begin + kSegment <= record.pressure.size(); begin += kSegment / 2) {
      const double a = LineAmplitude(record, begin, kSegment, f);
      sum += a * a;
    }
    frequency.push_back(f);
    power.push_back(sum);
  }
  const auto peak = [&](double lo, double hi) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < power.size(); ++i) {
      if (frequency[i] >= lo && frequency[i] <= hi && (best == 0 || power[i] > power[best]))
        best = i;
    }
    return best;
  };
  const std::size_t first = peak(100.0, 350.0);
  // Between 500 and 900 Hz, without the third harmonic of the first line (648 Hz).
  const std::size_t second = peak(670.0, 900.0);
  EXPECT_NEAR(frequency[first], 216.3, 5.0);
  EXPECT_NEAR(frequency[second], 746.0, 10.0);
  // Where Floquet's multipliers put the upper mode on top of the cycle.
  const LimitCycle cycle = LimitCycles(PaperLoop(0.415), 300.0).at(0);
  const FloquetMultipliers floquet = CycleStability(PaperLoop(0.415), cycle);
  const double offset_hz = std::abs(std::arg(floquet.multipliers[1])) / kTwoPi * cycle.frequency_hz;
  EXPECT_NEAR(3.0 * cycle.frequency_hz + offset_hz, 745.9, 0.5);
  // A line of its own: ten times what is between the two, and weaker and broader than the first.
  const auto at = [&](double f) {
    return power[static_cast<std::size_t>(std::lround((f - 100.0) / 5.0))];
  };
  EXPECT_GT(power[second], 10.0 * at(550.0));
  EXPECT_LT(power[second], 0.01 * power[first]);
  EXPECT_GT(at(frequency[second] + 10.0) / power[second],
            at(frequency[first] + 10.0) / power[first]);
}

TEST(Attractors, NoiseSwitchesBetweenThem) {
  // In the range where both cycles attract. Without noise each start stays where it is; with it
  // the run visits both, several times.
  constexpr double kMOverN = 0.70;
  constexpr std::size_t kWindow = 250;  // 50 ms
  const auto count = [&](const SimulatedRecord& record, int* low, int* high) {
    int switches = 0;
    int last = 0;
    for (std::size_t i = 0; i + kWindow <= record.pressure.size(); i += kWindow) {
      // Half of each cycle's own amplitude.
      const bool is_low = LineAmplitude(record, i, kWindow, 216.6) > 2.2;
      const bool is_high = LineAmplitude(record, i, kWindow, 750.3) > 0.62;
      if (is_low == is_high) continue;
      const int now = is_high ? 1 : -1;
      if (last != 0 && now != last) ++switches;
      last = now;
      ++*(is_high ? high : low);
    }
    return switches;
  };
  for (std::size_t start = 0; start < 2; ++start) {
    int low = 0;
    int high = 0;
    EXPECT_EQ(count(NoisyRun(kMOverN, 0.0, 5.0, 1, start), &low, &high), 0);
    EXPECT_EQ(start == 0 ? low : high, 100);
  }
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    int low = 0;
    int high = 0;
    const int switches = count(NoisyRun(kMOverN, 4e-6, 100.0, seed, 0), &low, &high);
    EXPECT_GE(switches, 6) << seed;
    EXPECT_GE(low, 200) << seed;
    EXPECT_GE(high, 200) << seed;
  }
}

TEST(Attractors, SweepsUpAndDownSwitchAtDifferentPlaces) {
  // M / N swept slowly: up from the lower cycle, which attracts until 0.923; down from the upper
  // one, which attracts until 0.625 (tests/model/continuation_test.cc).
  const auto sweep = [](double from, double to, std::size_t start_cycle) {
    SimulationCase one;
    one.rig.model = PaperLoop(from);
    one.rig.noise.combustion_density = 1e-10;  // enough to leave a cycle that no longer attracts
    one.rig.noise.combustion_corner_hz = 1500.0;
    one.rig.past = PastOnCycle(LimitCycles(one.rig.model, 900.0).at(start_cycle));
    one.rig.effects = {std::make_shared<LoopSchedule>(
        std::vector<LoopSchedule::Point>{{0.0, PaperLoop(from).loop, PaperLoop(from).flame},
                                         {40.0, PaperLoop(to).loop, PaperLoop(to).flame}})};
    SimulationOptions options;
    options.duration_s = 40.0;
    return Simulate(one, options);
  };
  const auto on_upper = [](const SimulatedRecord& record, double share) {
    const auto begin = static_cast<std::size_t>(share * 199000.0);
    const double low = LineAmplitude(record, begin, 1000, 216.7);
    const double high = LineAmplitude(record, begin, 1000, 750.5);
    EXPECT_TRUE((low > 2.2) != (high > 0.4)) << share << ": " << low << " " << high;
    return high > 0.4;
  };
  const SimulatedRecord up = sweep(0.70, 1.05, 0);
  EXPECT_FALSE(on_upper(up, (0.90 - 0.70) / 0.35));
  EXPECT_TRUE(on_upper(up, 1.0));
  const SimulatedRecord down = sweep(0.85, 0.50, 1);
  EXPECT_TRUE(on_upper(down, (0.85 - 0.65) / 0.35));
  EXPECT_FALSE(on_upper(down, 1.0));
}

}  // namespace
}  // namespace howl::attractors_test
