#include "estimation/family/answers/profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace howl::profile_test {
namespace {

// cost(x, y) = x^2 - 1.6 x y + y^2, x held: y = 0.8 x, cost 0.36 x^2. The edge at cost 1 is
// x = 1 / 0.6.
ConstrainedFit Quadratic(double x, const std::vector<double>&) {
  const double y = 0.8 * x;
  return {x * x - 1.6 * x * y + y * y, {x, y}, true};
}

TEST(ProfileTest, EdgesOfAQuadratic) {
  const Profile profile = ComputeProfile(Quadratic, 0.0, {0.0, {0.0, 0.0}, true},
                                         {.cost_max = 1.0, .first_step = 0.01});
  EXPECT_EQ(profile.lo_end, ProfileEnd::kEdge);
  EXPECT_EQ(profile.hi_end, ProfileEnd::kEdge);
  EXPECT_NEAR(profile.hi, 1 / 0.6, 1e-3);
  EXPECT_NEAR(profile.lo, -1 / 0.6, 1e-3);
  EXPECT_TRUE(profile.IsSound());
  EXPECT_GE(profile.points.size(), 10u);
  for (std::size_t k = 1; k < profile.points.size(); ++k) {
    EXPECT_LT(profile.points[k - 1].value, profile.points[k].value);
  }
}

// Flat one way to the bound, steep the other: nothing is cropped at symmetric bounds.
TEST(ProfileTest, OneSidedProfileReachesItsBound) {
  const auto cost = [](double x, const std::vector<double>&) {
    return ConstrainedFit{x > 1.0 ? 0.0 : (x - 1.0) * (x - 1.0), {x}, true};
  };
  const Profile profile =
      ComputeProfile(cost, 1.0, {0.0, {1.0}, true}, {.bounds = {0.0, 1000.0}, .cost_max = 0.25});
  EXPECT_EQ(profile.hi_end, ProfileEnd::kBound);
  EXPECT_EQ(profile.hi, 1000.0);
  EXPECT_EQ(profile.lo_end, ProfileEnd::kEdge);
  EXPECT_NEAR(profile.lo, 0.5, 1e-3);
}

// A search that sticks where it starts: the walk outwards follows a false minimum, and the way back
// finds the true one. The profile must say so.
TEST(ProfileTest, FlagsWhatDidNotConverge) {
  const auto cost = [](double x, const std::vector<double>& start) {
    // Two valleys in y: y = 0 with cost x^2, y = 1 with cost 0.3 x^2 + 0.1. Beyond x = 1.2 only the
    // second exists.
    const bool second = start[0] > 0.5 || std::abs(x) > 1.2;
    return ConstrainedFit{second ? 0.3 * x * x + 0.1 : x * x, {second ? 1.0 : 0.0}, true};
  };
  const Profile profile =
      ComputeProfile(cost, 0.0, {0.0, {0.0}, true}, {.cost_max = 2.0, .first_step = 0.05});
  EXPECT_GT(profile.flagged, 0u);
  EXPECT_FALSE(profile.IsSound());
  for (const ProfilePoint& point : profile.points) {
    const double best = std::min(point.value * point.value, 0.3 * point.value * point.value + 0.1);
    if (std::abs(point.value) > 0.5) {
      EXPECT_NEAR(point.cost, best, 1e-12) << point.value;
    }
  }
}

TEST(ProfileTest, SaysWhenTheStartWasNotTheBest) {
  const auto cost = [](double x, const std::vector<double>&) {
    return ConstrainedFit{(x - 2.0) * (x - 2.0), {x}, true};
  };
  const Profile profile =
      ComputeProfile(cost, 0.0, {4.0, {0.0}, true}, {.cost_max = 9.0, .first_step = 0.1});
  EXPECT_FALSE(profile.start_was_best);
  EXPECT_NEAR(profile.hi, 5.0, 1e-2);
  EXPECT_NEAR(profile.lo, -1.0, 1e-2);
}

TEST(ProfileTest, AFailingSearchEndsTheWalkAndIsNamed) {
  const auto cost = [](double x, const std::vector<double>&) {
    return ConstrainedFit{x > 0.5 ? std::nan("") : x * x, {x}, x <= 0.5};
  };
  const Profile profile =
      ComputeProfile(cost, 0.0, {0.0, {0.0}, true}, {.cost_max = 1.0, .first_step = 0.1});
  EXPECT_EQ(profile.hi_end, ProfileEnd::kFailed);
  EXPECT_NEAR(profile.hi, 0.5, 1e-3);
  EXPECT_EQ(profile.lo_end, ProfileEnd::kEdge);
}

}  // namespace
}  // namespace howl::profile_test
