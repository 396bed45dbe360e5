#include "estimation/family/answers/predict/stability_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <optional>
#include <random>

#include "estimation/family/answers/predict/leading_pole.h"
#include "estimation/family/members/enumerate.h"
#include "model/loop/poles.h"
#include "model/numerics/constants.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

namespace howl::stability_map_test {
namespace {

// The delay nearest to `tau_s` at which a loop with one mode is neutral: |k s G| = 1 is
//
//   (k N)^2 w^4 = (o^2 - w^2)^2 + (2 o xi w)^2,
//
// a quadratic in w^2, and k s G e^(-tau s) = 1 is then w tau = -arg(o^2 - w^2 + 2 j o xi w) (mod 2
// pi) for k < 0.
std::optional<double> NeutralDelay(const LoopModel& m, double k, double tau_s) {
  const double o = 2.0 * kPi * m.omega_hz;
  const double a = 1.0 - k * k * m.N * m.N;
  const double b = o * o * (4.0 * m.xi * m.xi - 2.0);
  const double root = std::sqrt(b * b - 4.0 * a * o * o * o * o);
  std::optional<double> nearest;
  for (const double square : {(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)}) {
    if (!(square > 0.0)) continue;
    const double w = std::sqrt(square);
    const double phase = -std::arg(std::complex<double>(o * o - square, 2.0 * o * m.xi * w));
    for (int turns = 0; turns < 4; ++turns) {
      const double tau = (phase + 2.0 * kPi * turns) / w;
      if (!nearest || std::abs(tau - tau_s) < std::abs(*nearest - tau_s)) nearest = tau;
    }
  }
  return nearest;
}

FamilyProblem OneMode() { return {.experiments = R228Reliable()}; }

std::vector<MemberPath> PathsOf(const FamilyProblem& problem, const OperatingPoints& points,
                                std::size_t members) {
  return MakePaths(problem, points, EnumerateMembers(problem, members, 1, 2).members, 1, 2);
}

LoopModel RandomLoop(std::mt19937& random, double modes) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double omega = 150.0 + 150.0 * unit(random);
  const double n = 1000.0 + 5000.0 * unit(random);
  return {.omega_hz = omega,
          .xi = 0.005 + 0.2 * unit(random),
          .N = n,
          .M = modes > 1 ? n * unit(random) : 0.0,
          .tau_s = 1e-3 + 6e-3 * unit(random)};
}

// Against all poles, found by a discretised generator and counted by the argument principle.
TEST(LeadingPoleTest, IsTheRightmostPoleWhereTheLoopIsUnstable) {
  std::mt19937 random(3);
  int unstable = 0, stable = 0, same = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const LoopModel model = RandomLoop(random, trial % 2 == 0 ? 1 : 2);
    const double slope = -0.7e-4;
    const PoleSet all = ClosedLoopPoles(model.Loop(), slope);
    if (!all.complete) continue;
    const std::optional<Pole> leading = LeadingPole(model.Loop(), slope);
    const bool grows = !all.poles.empty() && all.poles.front().growth_rate > 0.0;
    ASSERT_EQ(leading && leading->growth_rate > 0.0, grows) << trial;
    ++(grows ? unstable : stable);
    const std::optional<Pole> first =
        grows ? all.poles.front() : RightmostPole(model.Loop(), slope);
    ASSERT_TRUE(leading && first);
    if (!grows) {
      EXPECT_LE(leading->growth_rate, first->growth_rate + 1e-6 * std::abs(first->growth_rate));
      if (std::abs(leading->growth_rate / first->growth_rate - 1.0) < 1e-6) ++same;
      continue;
    }
    EXPECT_NEAR(leading->growth_rate / all.poles.front().growth_rate, 1.0, 1e-6) << trial;
    EXPECT_NEAR(leading->frequency_hz / all.poles.front().frequency_hz, 1.0, 1e-8) << trial;
  }
  EXPECT_GT(unstable, 50);
  EXPECT_GT(stable, 50);
  EXPECT_GT(same, 0.9 * stable) << same << " of " << stable;
}

// The boundary on the map is where |L Phi'(0)| = 1 has it in closed form.
TEST(StabilityMapTest, TheGrowthRateChangesItsSignAtTheNeutralDelay) {
  const FamilyProblem problem = OneMode();
  const OperatingPoints points(problem.experiments);
  const std::vector<MemberPath> paths = PathsOf(problem, points, 40);
  int checked = 0;
  for (const double phi : {0.51, 0.545, 0.56}) {
    for (std::size_t m = 0; m < paths.size(); m += 10) {
      const std::optional<OperatingLoop> loop = paths[m].At(points, phi);
      ASSERT_TRUE(loop);
      const auto tau = NeutralDelay(loop->model, loop->flame_slope, loop->model.tau_s);
      ASSERT_TRUE(tau);
      const double step = 1e-3 * *tau;
      const StabilityMap map = MakeStabilityMap(
          points, std::span(paths).subspan(m, 1), {MapQuantity::kOperatingPoint, {phi}},
          {MapQuantity::kTau, {*tau - step, *tau, *tau + step}}, 0.0, 1);
      const double before = map.At(0, 0).growth_rate.median;
      const double after = map.At(0, 2).growth_rate.median;
      EXPECT_LT(before * after, 0.0);
      EXPECT_NEAR(map.At(0, 1).growth_rate.median, 0.0, 1e-6 * std::abs(after - before));
      EXPECT_NE(map.At(0, 0).share_unstable, map.At(0, 2).share_unstable);
      ++checked;
    }
  }
  EXPECT_GT(checked, 20);
}

TEST(StabilityMapTest, AtTheMembersOwnValuesItIsThePrediction) {
  const FamilyProblem problem = OneMode();
  const OperatingPoints points(problem.experiments);
  const std::vector<MemberPath> all = PathsOf(problem, points, 200);
  const std::span<const MemberPath> one(&all[7], 1);
  for (const double phi : {0.52, 0.56}) {
    const PointPrediction predicted =
        PredictPoints(problem, points, one, {}, std::span(&phi, 1), 1).front();
    const double tau = one.front().At(points, phi)->model.tau_s;
    const StabilityMap map = MakeStabilityMap(points, one, {MapQuantity::kOperatingPoint, {phi}},
                                              {MapQuantity::kTau, {tau}}, 0.0, 1);
    EXPECT_NEAR(map.At(0, 0).growth_rate.median / predicted.growth_rate.median, 1.0, 1e-9);
    EXPECT_DOUBLE_EQ(MapValuesAt(points, one, MapQuantity::kTau, phi).median, tau);
  }
}

TEST(StabilityMapTest, EveryParameterIsTheOneThatIsSet) {
  const OperatingLoop loop{.model = {200.0, 0.1, 3000.0, 900.0, 3e-3},
                           .frequency_hz = 205.0,
                           .gain = 12.0,
                           .flame_slope = -7e-5};
  const std::array values = {210.0, 0.2, 4000.0, 1000.0, 4e-3, -8e-5};
  for (std::size_t k = 0; k < kMapParameters.size(); ++k) {
    const OperatingLoop other = WithMapValue(loop, kMapParameters[k], values[k]);
    for (std::size_t each = 0; each < kMapParameters.size(); ++each) {
      EXPECT_EQ(MapValue(other, kMapParameters[each]),
                each == k ? values[k] : MapValue(loop, kMapParameters[each]));
    }
  }
}

TEST(StabilityMapTest, MoreDampingNeverMakesALoopGrowAndThreadsDoNotMatter) {
  const FamilyProblem problem = OneMode();
  const OperatingPoints points(problem.experiments);
  const std::vector<MemberPath> paths = PathsOf(problem, points, 60);
  const MapAxis phi{MapQuantity::kOperatingPoint, {0.49, 0.51, 0.53, 0.56, 0.9}};
  const MapAxis xi{MapQuantity::kXi, {0.02, 0.06, 0.1, 0.2, 0.4}};
  const StabilityMap one = MakeStabilityMap(points, paths, phi, xi, 0.0, 1);
  const StabilityMap two = MakeStabilityMap(points, paths, phi, xi, 0.0, 2);
  EXPECT_EQ(one.paths, kMostMapPaths);
  for (std::size_t i = 0; i < phi.values.size(); ++i) {
    for (std::size_t j = 0; j < xi.values.size(); ++j) {
      if (i == 4) {
        EXPECT_EQ(one.At(i, j).members, 0u);  // outside of what the data can say
        EXPECT_TRUE(std::isnan(one.At(i, j).growth_rate.median));
        continue;
      }
      EXPECT_EQ(one.At(i, j).growth_rate.median, two.At(i, j).growth_rate.median);
      EXPECT_EQ(one.At(i, j).share_unstable, two.At(i, j).share_unstable);
      EXPECT_LE(one.At(i, j).growth_rate.lo, one.At(i, j).growth_rate.median);
      if (j > 0) {
        EXPECT_LE(one.At(i, j).share_unstable, one.At(i, j - 1).share_unstable);
      }
    }
    if (i < 4) {
      EXPECT_GT(one.At(i, 0).share_unstable, 0.5);
      EXPECT_EQ(one.At(i, 4).share_unstable, 0.0);
    }
  }
}

}  // namespace
}  // namespace howl::stability_map_test
