// A response that is known, of samples of which some are of no use.
#include "estimation/analysis/instruments/response_by_least_squares.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace howl::response_by_least_squares_test {
namespace {

constexpr std::size_t kSamples = 700;  // more of them of no use than are taken away at once
constexpr ResponseSpan kSpan{2, 4};

std::vector<double> Noise(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> out(kSamples);
  for (double& value : out) value = normal(random);
  return out;
}

TEST(ResponseByLeastSquares, FindsAResponseOfItsLengthExactly) {
  const std::vector<double> y = Noise(1);
  std::vector<double> x = Noise(2);
  std::vector<bool> used(kSamples);
  std::vector<double> truth(kSamples);
  for (std::size_t t = kSpan.back; t < kSamples - kSpan.ahead; ++t) {
    truth[t] = 3.0 + 2.0 * y[t + 2] - y[t] + 0.5 * y[t - 4];
    used[t] = t % 5 < 2;
    if (used[t]) x[t] = truth[t];
  }
  const std::vector<double> found = ResponseByLeastSquares(y, used, kSpan).Predict(x);
  for (std::size_t t = 0; t < kSamples; ++t) EXPECT_NEAR(found[t], truth[t], 1e-7) << t;
}

// The errors of least squares are those of the normal equations: what is left of x is orthogonal to
// every regressor and to the constant, over the samples in use.
TEST(ResponseByLeastSquares, LeavesWhatIsOrthogonalToAllRegressors) {
  const std::vector<double> y = Noise(3);
  const std::vector<double> x = Noise(4);
  std::vector<bool> used(kSamples);
  for (std::size_t t = 0; t < kSamples; ++t) used[t] = t % 3 != 0;
  const std::vector<double> found = ResponseByLeastSquares(y, used, kSpan).Predict(x);
  for (std::ptrdiff_t k = -2; k <= 5; ++k) {  // at 5 the constant
    double product = 0.0;
    for (std::size_t t = kSpan.back; t < kSamples - kSpan.ahead; ++t) {
      if (!used[t]) continue;
      const double regressor =
          k == 5 ? 1.0 : y[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(t) - k)];
      product += regressor * (x[t] - found[t]);
    }
    EXPECT_NEAR(product, 0.0, 1e-5) << k;
  }
}

TEST(ResponseByLeastSquares, WithoutAnySampleThereIsNone) {
  const std::vector<double> y = Noise(5);
  const std::vector<double> found =
      ResponseByLeastSquares(y, std::vector<bool>(kSamples, false), kSpan).Predict(y);
  for (const double value : found) EXPECT_EQ(value, 0.0);
}

}  // namespace
}  // namespace howl::response_by_least_squares_test
