#include "estimation/analysis/instruments/linear_prediction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace howl::linear_prediction_test {
namespace {

TEST(LinearPrediction, FindsTheCoefficientsOfAnAutoregression) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const double r = 0.97, angle = 0.3;
  const double a1 = -2.0 * r * std::cos(angle), a2 = r * r;
  std::vector<double> y = {0.0, 0.0};
  for (int i = 0; i < 40000; ++i) {
    const std::size_t n = y.size();
    y.push_back(-a1 * y[n - 1] - a2 * y[n - 2] + normal(random));
  }
  const std::vector<double> a = BurgCoefficients(y, 2);
  ASSERT_EQ(a.size(), 2U);
  // The standard deviation of either is sqrt((1 - a2^2) / n) = 0.0017.
  EXPECT_NEAR(a[0], a1, 4.0 * 0.0017);
  EXPECT_NEAR(a[1], a2, 4.0 * 0.0017);
}

TEST(LinearPrediction, GoesOnWithTones) {
  const auto truth = [](int i) { return std::cos(0.27 * i + 0.4) + 0.2 * std::sin(0.81 * i); };
  std::vector<double> y;
  for (int i = 0; i < 4000; ++i) y.push_back(truth(i));
  const std::vector<double> next = PredictOnward(y, 100);
  ASSERT_EQ(next.size(), 100U);
  for (int i = 0; i < 100; ++i)
    EXPECT_NEAR(next[static_cast<std::size_t>(i)], truth(4000 + i), 1e-3);
}

TEST(LinearPrediction, StaysFiniteAndWithinBounds) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const std::size_t samples : {8U, 16U, 100U, 5000U}) {
    std::vector<double> y(samples);
    for (double& value : y) value = normal(random);
    for (const double value : PredictOnward(y, 2000)) EXPECT_LT(std::abs(value), 20.0);
  }
  for (const double value : PredictOnward(std::vector<double>(50, 0.0), 10)) EXPECT_EQ(value, 0.0);
}

}  // namespace
}  // namespace howl::linear_prediction_test
