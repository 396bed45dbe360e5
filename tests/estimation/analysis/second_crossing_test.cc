// Which lines close the loop a second time: a loop whose phase and gain at a line are known.
#include "estimation/analysis/second_crossing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace howl::second_crossing_test {
namespace {

// A cycle at 200 Hz with the delay 3.5 ms, and a line whose phase is that of a closed loop, less
// `error_deg`, with `loop_gain` at rest.
Analysis WithLine(double frequency_hz, double error_deg, double loop_gain) {
  Analysis analysis;
  analysis.has_heat_release = true;
  analysis.characteristics.frequency_hz = {200.0, 0.01};
  analysis.characteristics.gain = {15.0, 0.1};
  analysis.characteristics.p_amplitude = 1.0;
  analysis.tau_s = Estimate{0.0035, 1e-6};
  analysis.loop_gain = Estimate{1.2, 0.01};
  SpectralLine line;
  line.frequency_hz = {frequency_hz, 0.1};
  line.phase_deg = {std::remainder(90.0 + 360.0 * frequency_hz * 0.0035 + error_deg, 360.0), 2.0};
  line.p_amplitude = 0.1;
  line.q_amplitude = 0.1 / (15.0 * loop_gain / 1.2 * 200.0 / frequency_hz);
  line.coherence = 0.99;
  analysis.lines.push_back(line);
  return analysis;
}

TEST(SecondCrossing, PhaseAndGainAreThoseOfTheLine) {
  const Analysis analysis = WithLine(750.0, 17.0, 1.4);
  const Estimate error = LoopPhaseErrorAt(analysis, analysis.lines[0]);
  EXPECT_NEAR(error.value, 17.0, 1e-9);
  EXPECT_NEAR(error.std, std::hypot(2.0, 360.0 * 750.0 * 1e-6), 1e-9);
  EXPECT_NEAR(LoopGainAt(analysis, analysis.lines[0]).value, 1.4, 1e-9);
  EXPECT_EQ(FindSecondCrossing(analysis), &analysis.lines[0]);
}

TEST(SecondCrossing, ALineThatMissesThePhaseOrTheGainIsNone) {
  EXPECT_EQ(FindSecondCrossing(WithLine(750.0, 90.0, 1.4)), nullptr);
  EXPECT_EQ(FindSecondCrossing(WithLine(750.0, 0.0, 0.4)), nullptr);
}

TEST(SecondCrossing, NeitherIsAMultipleNorOneBelowTheCycleNorAWeakOne) {
  Analysis analysis = WithLine(750.0, 0.0, 1.4);
  analysis.lines[0].harmonic = 4;
  EXPECT_EQ(FindSecondCrossing(analysis), nullptr);
  EXPECT_EQ(FindSecondCrossing(WithLine(150.0, 0.0, 1.4)), nullptr);
  analysis = WithLine(750.0, 0.0, 1.4);
  analysis.lines[0].p_amplitude = 0.005;
  EXPECT_EQ(FindSecondCrossing(analysis), nullptr);
}

// Its companions lie by chance where the loop closes.
TEST(SecondCrossing, AStrongerLineThatDoesNotCloseTheLoopLeavesNone) {
  Analysis analysis = WithLine(750.0, 0.0, 1.4);
  Analysis other = WithLine(430.0, 120.0, 1.4);
  other.lines[0].p_amplitude *= 2.0;
  analysis.lines.push_back(other.lines[0]);
  EXPECT_EQ(FindSecondCrossing(analysis), nullptr);
}

}  // namespace
}  // namespace howl::second_crossing_test
