// Priors with Student's tails, against their densities.
#include "estimation/record_fit/loop/point_prior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace howl::point_prior_test {
namespace {

PointPrior OneNormalOneStudent() {
  PointPrior prior;
  prior.mean = Eigen::Vector2d(1.0, -2.0);
  prior.deviation = Eigen::Vector2d(0.5, 0.1);
  prior.degrees = Eigen::Vector2d(std::numeric_limits<double>::infinity(), 4.0);
  return prior;
}

// A search begins where the density has fallen by eighteen nats at the most.
TEST(PointPrior, WithinIsWhereTheDensityHasNotVanished) {
  const PointPrior prior = OneNormalOneStudent();
  const double top = prior.LogDensity(prior.mean);
  for (int i = 0; i < 2; ++i) {
    Eigen::VectorXd far = prior.mean;
    far[i] += 1e3;
    const Eigen::VectorXd within = prior.Within(far);
    EXPECT_NEAR(prior.LogDensity(within), top - 18.0, 1e-9);
    EXPECT_EQ(prior.Within(within), within);
  }
}

TEST(PointPrior, NormalHasTheSameSlope) {
  const PointPrior prior = OneNormalOneStudent();
  const Eigen::VectorXd at = prior.mean + Eigen::Vector2d(0.3, 0.5);
  const PointPrior normal = prior.NormalAt(at);
  EXPECT_EQ(normal.degrees.size(), 0);
  for (int i = 0; i < 2; ++i) {
    Eigen::VectorXd above = at;
    Eigen::VectorXd below = at;
    above[i] += 1e-6;
    below[i] -= 1e-6;
    const auto slope = [&](const PointPrior& of) {
      return (of.LogDensity(above) - of.LogDensity(below)) / 2e-6;
    };
    EXPECT_NEAR(slope(normal), slope(prior), 1e-6);
  }
}

// Near its middle Student's density, and far out as steep as a normal one of the widest deviation.
TEST(PointPrior, TailsEndAsTheWidestNormalDoes) {
  PointPrior prior = OneNormalOneStudent();
  const PointPrior endless = prior;
  prior.widest = Eigen::Vector2d(0.5, 0.4);
  const auto slope = [](const PointPrior& of, double u) {
    const double step = 1e-5;
    return (of.LogDensity(Eigen::Vector2d(1.0, u + step)) -
            of.LogDensity(Eigen::Vector2d(1.0, u - step))) /
           (2.0 * step);
  };
  double before = prior.LogDensity(prior.mean);
  for (double u = -2.0; u < 10.0; u += 0.01) {
    const Eigen::Vector2d at(1.0, u);
    const double by_z = prior.Slope(at)[1];
    EXPECT_NEAR(slope(prior, u), by_z / prior.deviation[1], 1e-4) << u;
    EXPECT_LE(prior.LogDensity(at), before + 1e-12) << u;
    before = prior.LogDensity(at);
  }
  const Eigen::Vector2d near(1.0, -1.7);
  EXPECT_EQ(prior.LogDensity(near), endless.LogDensity(near));
  EXPECT_NEAR(slope(prior, 5.0), -(5.0 + 2.0) / (0.4 * 0.4), 1e-4);
}

}  // namespace
}  // namespace howl::point_prior_test
