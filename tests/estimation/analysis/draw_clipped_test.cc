// p that is cut off at the ends of a range, and is known as it was: how far what is drawn lies from
// it, and whether the draws tell so.
#include "estimation/analysis/instruments/draw_clipped.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/estimation/analysis/resonant_record.h"

namespace howl::draw_clipped_test {
namespace {

constexpr double kRateHz = 5000.0;
constexpr std::size_t kSamples = 12000;
constexpr std::size_t kBack = 500;  // samples that are cut off: 20 periods, and 3 at the end
constexpr std::size_t kAhead = 75;
constexpr double kNoise = ResonantRecord::kNoise;

struct Case {
  Record truth;  // as far as the drawn one reaches
  Record drawn;
  RangeEnds ends;

  bool IsLost(std::size_t t) const {
    return truth.pressure[t] >= ends.upper || truth.pressure[t] <= ends.lower;
  }
};

double Largest(const std::vector<double>& x) { return *std::ranges::max_element(x); }

// Beyond this share of the largest value.
Case Clipped(std::uint64_t seed, double of_largest, bool both = true) {
  Case out;
  out.truth = MakeResonantRecord(seed, kRateHz, kSamples);
  out.ends.upper = of_largest * Largest(out.truth.pressure);
  if (both) out.ends.lower = -out.ends.upper;
  Record recorded = out.truth;
  for (double& value : recorded.pressure) {
    value = std::clamp(value, out.ends.lower, out.ends.upper);
  }
  out.drawn = WithClippedDrawn(recorded, out.ends, ResonantRecord::kCycleHz, seed);
  for (std::vector<double>* x : {&out.truth.pressure, &out.truth.heat_release}) {
    x->erase(x->end() - static_cast<std::ptrdiff_t>(kAhead), x->end());
    x->erase(x->begin(), x->begin() + static_cast<std::ptrdiff_t>(kBack));
  }
  return out;
}

double MeanSquareAt(const Record& drawn, std::size_t t) {
  double sum = 0.0;
  for (const std::vector<double>& each : drawn.pressure_errors) sum += each[t] * each[t];
  return sum / static_cast<double>(drawn.pressure_errors.size());
}

// The sensor's noise is all that q does not tell: of the truth and of what is drawn, and beside it
// the response's errors, which at half the largest value are two fifths of all. Errors that are
// alike in all periods average out over records only.
TEST(DrawClipped, IsAsFarFromTheTruthAsItsErrorsSay) {
  for (const double of_largest : {0.8, 0.7, 0.5}) {
    double square = 0.0;
    double told = 0.0;
    double lost = 0.0;
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Case at = Clipped(seed, of_largest);
      ASSERT_EQ(at.drawn.pressure.size(), at.truth.pressure.size());
      for (std::size_t t = 0; t < at.truth.pressure.size(); ++t) {
        if (!at.IsLost(t)) continue;
        square += std::pow(at.drawn.pressure[t] - at.truth.pressure[t], 2);
        told += 2.0 * kNoise * kNoise + MeanSquareAt(at.drawn, t);
        ++lost;
      }
    }
    ASSERT_GT(lost, 1000.0);
    EXPECT_NEAR(square / told, 1.0, 0.2) << of_largest;
    EXPECT_LT(told / lost, 3.0 * kNoise * kNoise) << of_largest;
  }
}

double PowerAt(double multiple, const std::vector<double>& x) {
  const double turn = 2.0 * std::numbers::pi * multiple * ResonantRecord::kCycleHz / kRateHz;
  const auto n = static_cast<double>(x.size());
  std::complex<double> sum = 0.0;
  for (std::size_t t = 0; t < x.size(); ++t) {
    const auto at = static_cast<double>(t);
    sum += x[t] * std::sin(std::numbers::pi * at / n) * std::polar(1.0, -turn * at);
  }
  return std::norm(sum);
}

// What errs alike in all periods errs at the cycle's lines, of which a loop's fit knows best.
TEST(DrawClipped, SoItIsAtTheCyclesLines) {
  constexpr int kRecords = 10;
  constexpr std::array kMultiples = {1.0, 3.0};
  std::array<double, 2> ratio = {};
  for (std::uint64_t seed = 1; seed <= kRecords; ++seed) {
    const Case at = Clipped(seed, 0.7);
    std::vector<double> error = at.drawn.pressure;
    for (std::size_t t = 0; t < error.size(); ++t) error[t] -= at.truth.pressure[t];
    double lost = 0.0;
    for (std::size_t t = 0; t < error.size(); ++t) {
      const double taper =
          std::sin(std::numbers::pi * static_cast<double>(t) / static_cast<double>(error.size()));
      if (at.IsLost(t)) lost += taper * taper;
    }
    for (std::size_t i = 0; i < kMultiples.size(); ++i) {
      double told = 2.0 * kNoise * kNoise * lost;
      for (const std::vector<double>& each : at.drawn.pressure_errors) {
        told += PowerAt(kMultiples[i], each) / static_cast<double>(at.drawn.pressure_errors.size());
      }
      ratio[i] += PowerAt(kMultiples[i], error) / told / kRecords;
    }
  }
  // Of one record it is no more than Fisher's F with 2 and 32 degrees: mean 1.07, deviation 1.17.
  for (const double each : ratio) EXPECT_NEAR(each, 1.0, 4.0 * 1.17 / std::sqrt(kRecords));
}

TEST(DrawClipped, LeavesWhatWasRecordedAndLiesBeyondTheEnds) {
  const Case at = Clipped(2, 0.6, false);
  EXPECT_EQ(at.drawn.heat_release, at.truth.heat_release);
  for (std::size_t t = 0; t < at.truth.pressure.size(); ++t) {
    if (at.IsLost(t)) {
      EXPECT_GE(at.drawn.pressure[t], at.ends.upper - 1e-12) << t;
    } else {
      EXPECT_NEAR(at.drawn.pressure[t], at.truth.pressure[t], 1e-12) << t;
    }
  }
}

// Between ends so near one another no time tells that p lies there.
TEST(DrawClipped, LeavesARecordThatTellsTooLittle) {
  Record recorded = MakeResonantRecord(3, kRateHz, kSamples);
  RangeEnds ends;
  ends.upper = 1e-3 * Largest(recorded.pressure);
  ends.lower = -ends.upper;
  for (double& value : recorded.pressure) value = std::clamp(value, ends.lower, ends.upper);
  const Record same = WithClippedDrawn(recorded, ends, ResonantRecord::kCycleHz, 1);
  EXPECT_EQ(same.pressure, recorded.pressure);
  EXPECT_TRUE(same.pressure_errors.empty());
  EXPECT_EQ(same.lost_share, 0.0);
}

// p without noise of its own is what q tells.
TEST(DrawClipped, FindsWhatQTellsAllOf) {
  Record truth = MakeResonantRecord(5, kRateHz, kSamples);
  truth.pressure = truth.heat_release;
  RangeEnds ends;
  ends.upper = 0.7 * Largest(truth.pressure);
  Record recorded = truth;
  for (double& value : recorded.pressure) value = std::min(value, ends.upper);
  const Record drawn = WithClippedDrawn(recorded, ends, ResonantRecord::kCycleHz, 1);
  ASSERT_EQ(drawn.pressure.size(), kSamples - kBack - kAhead);
  for (std::size_t t = 0; t < drawn.pressure.size(); ++t) {
    EXPECT_NEAR(drawn.pressure[t], truth.pressure[t + kBack], 1e-5 * ends.upper) << t;
  }
}

TEST(DrawClipped, HangsOnTheSeedAlone) {
  const Case at = Clipped(3, 0.8);
  EXPECT_EQ(at.drawn.pressure, Clipped(3, 0.8).drawn.pressure);
  Record recorded = MakeResonantRecord(3, kRateHz, kSamples);
  for (double& value : recorded.pressure) {
    value = std::clamp(value, at.ends.lower, at.ends.upper);
  }
  EXPECT_NE(at.drawn.pressure,
            WithClippedDrawn(recorded, at.ends, ResonantRecord::kCycleHz, 4).pressure);
}

}  // namespace
}  // namespace howl::draw_clipped_test
