// Truth: the chi-square distribution of Boost.Math where its tail does not underflow, and the
// printed quantiles of Abramowitz and Stegun, table 26.8.
#include "estimation/analysis/transfer/joint_deviation.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace howl::joint_deviation_test {
namespace {

double Tail(double distance, int count) {
  return cdf(complement(boost::math::chi_squared(count), distance * distance));
}

TEST(JointDeviation, IsAsImprobableForOneNumberAsTheDistanceForAll) {
  for (int count = 1; count <= 12; ++count) {
    for (const double distance : {0.5, 1.0, 2.0, 4.0, 7.9, 8.6, 12.0, 25.0, 35.0}) {
      const double z = DeviationOfDistance(distance, count);
      const double expected = Tail(distance, count);
      // Of a deviation that is small in itself the tail says 1 - P, which rounds.
      EXPECT_NEAR(Tail(z, 1) / expected, 1.0, 1e-11 * (1.0 + distance * distance))
          << count << " " << distance;
    }
  }
}

TEST(JointDeviation, ReadsThePrintedQuantiles) {
  // P = 0.05 and 0.001: chi-square of 1, 3 and 4 degrees of freedom.
  EXPECT_NEAR(DistanceOfDeviation(std::sqrt(3.84146), 4), std::sqrt(9.48773), 1e-5);
  EXPECT_NEAR(DistanceOfDeviation(std::sqrt(3.84146), 3), std::sqrt(7.81473), 1e-5);
  EXPECT_NEAR(DistanceOfDeviation(std::sqrt(10.828), 4), std::sqrt(18.467), 1e-4);
  EXPECT_NEAR(DistanceOfDeviation(std::sqrt(10.828), 2), std::sqrt(13.816), 1e-4);
}

TEST(JointDeviation, TurnsBackAndGrowsWithoutLimit) {
  for (int count = 1; count <= 12; ++count) {
    double before = -1.0;
    for (const double z : {0.0, 0.01, 0.3, 1.0, 4.0, 9.0, 37.0, 38.0, 100.0, 1e4, 1e8}) {
      const double distance = DistanceOfDeviation(z, count);
      EXPECT_GT(distance, before);
      EXPECT_GE(distance, z);
      EXPECT_NEAR(DeviationOfDistance(distance, count), z, 1e-11 * (1.0 + z)) << count << " " << z;
      before = distance;
    }
  }
}

}  // namespace
}  // namespace howl::joint_deviation_test
