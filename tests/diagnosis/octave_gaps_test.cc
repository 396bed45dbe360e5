// The gap of each octave, against sums by hand.
#include "diagnosis/held_out/octave_gaps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace howl::octave_gaps_test {
namespace {

// Bands of p at 50, 90, 110 and 200 Hz, of q the same; errors over ceilings of one.
std::vector<BandErrors> Half(const std::vector<double>& errors) {
  std::vector<BandErrors> out;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double middle = std::vector{50.0, 90.0, 110.0, 200.0}[i % 4];
    out.push_back(
        {.low_hz = middle - 5.0, .high_hz = middle + 5.0, .error = errors[i], .ceiling = 1.0});
  }
  return out;
}

TEST(OctaveGaps, AreThoseOfTheirBands) {
  HeldOutScore score;
  score.errors = {{Half({1.1, 1.5, 1.3, 1.0, 1.0, 2.0, 1.0, 0.9}),
                   Half({1.3, 1.1, 1.1, 1.0, 1.0, 1.0, 1.0, 0.7})}};
  const std::vector<OctaveGap> gaps = GapsByOctave({"a"}, {100.0}, score);
  ASSERT_EQ(gaps.size(), 6u);
  const std::vector<double> squares = {0.2, 0.25, 0.0, 0.0, 0.25, -0.2};
  const std::vector<double> sums = {0.4, 1.0, 0.0, 0.0, 1.0, -0.4};
  double shares = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(gaps[i].octave, static_cast<int>(i % 3) - 1);
    EXPECT_EQ(gaps[i].block, i < 3 ? LoopBlock::kAcoustics : LoopBlock::kFlame);
    EXPECT_NEAR(gaps[i].gap, std::copysign(std::sqrt(std::abs(squares[i])), squares[i]), 1e-7);
    EXPECT_NEAR(gaps[i].share, sums[i] / 2.0, 1e-12);
    shares += gaps[i].share;
  }
  EXPECT_EQ(gaps[1].low_hz, 85.0);
  EXPECT_EQ(gaps[1].high_hz, 115.0);
  EXPECT_NEAR(shares, 1.0, 1e-12);
}

}  // namespace
}  // namespace howl::octave_gaps_test
