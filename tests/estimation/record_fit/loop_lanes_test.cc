// Loops over bins, eight at a time and what is left, against one bin after another.
#include "estimation/record_fit/loop/loop_lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

namespace howl::loop_lanes_test {
namespace {

using C = std::complex<double>;

// Numbers that need no generator.
C Number(std::size_t i) {
  const auto at = static_cast<double>(i);
  return std::polar(1.0 + 0.5 * std::sin(1.7 * at), 0.9 * at);
}

std::vector<C> Numbers(std::size_t count, std::size_t first) {
  std::vector<C> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(Number(first + i));
  return out;
}

constexpr LoopMode kMode{.omega = 1.3, .xi = 0.2, .a = 0.7, .b = -0.4, .g = 0.3, .h = 0.9};

// Fewer than the lanes, as many, more, and several times as many with all rests.
class LoopLanes : public testing::TestWithParam<std::size_t> {
 protected:
  LoopLanes() {
    for (std::size_t i = 0; i < count_; ++i) x_.push_back(0.1 + 0.2 * static_cast<double>(i));
  }

  C S(std::size_t i) const { return {0.0, x_[i]}; }
  std::ptrdiff_t Count() const { return static_cast<std::ptrdiff_t>(count_); }
  void ExpectNear(const std::vector<C>& found, std::size_t i, C expected) const {
    EXPECT_NEAR(std::abs(found[i] - expected), 0.0, 1e-13 * (1.0 + std::abs(expected))) << i;
  }

  const std::size_t count_ = GetParam();
  std::vector<double> x_;
  const std::vector<C> a_ = Numbers(count_, 0);
  const std::vector<C> b_ = Numbers(count_, 500);
  const std::vector<C> c_ = Numbers(count_, 900);
};

TEST_P(LoopLanes, SetResonances) {
  std::vector<C> found(count_);
  SetResonance(kMode, x_.data(), Count(), found.data());
  for (std::size_t i = 0; i < count_; ++i) {
    const C s = S(i);
    ExpectNear(found, i,
               1.0 / (s * s + 2.0 * kMode.xi * kMode.omega * s + kMode.omega * kMode.omega));
  }
}

TEST_P(LoopLanes, AddTransfers) {
  std::vector<C> found = a_;
  AddTransfer(kMode, x_.data(), b_.data(), Count(), found.data());
  for (std::size_t i = 0; i < count_; ++i) {
    ExpectNear(found, i, a_[i] + (kMode.a * S(i) + kMode.b * kMode.omega) * b_[i]);
  }
}

TEST_P(LoopLanes, AddAnswers) {
  std::vector<C> found = a_;
  AddAnswer(kMode, x_.data(), b_.data(), c_.data(), Count(), found.data());
  for (std::size_t i = 0; i < count_; ++i) {
    const C driven =
        (kMode.a * S(i) + kMode.b * kMode.omega) * b_[i] + kMode.g * S(i) + kMode.h * kMode.omega;
    ExpectNear(found, i, a_[i] + driven * c_[i]);
  }
}

TEST_P(LoopLanes, LeaveTheTapersDifferences) {
  std::vector<C> found(count_ - 1);
  std::vector<C> with_factors(count_ - 1);
  SetLeft(a_.data(), b_.data(), nullptr, Count(), found.data());
  SetLeft(a_.data(), b_.data(), c_.data(), Count(), with_factors.data());
  for (std::size_t i = 0; i + 1 < count_; ++i) {
    ExpectNear(found, i, (a_[i] - b_[i]) - (a_[i + 1] - b_[i + 1]));
    ExpectNear(with_factors, i, (a_[i] - b_[i] * c_[i]) - (a_[i + 1] - b_[i + 1] * c_[i + 1]));
  }
}

TEST_P(LoopLanes, MultiplyInPlace) {
  std::vector<C> found = a_;
  SetProducts(found.data(), b_.data(), Count(), found.data());
  for (std::size_t i = 0; i < count_; ++i) ExpectNear(found, i, a_[i] * b_[i]);
}

TEST_P(LoopLanes, SumUp) {
  C product = 0.0;
  C sums[5] = {};
  for (std::size_t i = 0; i < count_; ++i) {
    product += a_[i] * b_[i] * c_[i];
    const C s = S(i);
    const C once = a_[i] * b_[i];
    const C twice = once * b_[i];
    sums[0] += once;
    sums[1] += s * once;
    sums[2] += twice;
    sums[3] += s * twice;
    sums[4] += s * s * twice;
  }
  EXPECT_NEAR(SumOfProducts(a_.data(), b_.data(), c_.data(), Count()), product.real(), 1e-12);
  const ModeSums found = SumsOfMode(a_.data(), x_.data(), b_.data(), Count());
  const double of[5] = {found.o, found.s_o, found.oo, found.s_oo, found.ss_oo};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(of[k], sums[k].real(), 1e-11) << k;
}

INSTANTIATE_TEST_SUITE_P(Counts, LoopLanes, testing::Values(2, 7, 8, 9, 16, 17, 69));

}  // namespace
}  // namespace howl::loop_lanes_test
