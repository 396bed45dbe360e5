#include "estimation/family/answers/tradeoff.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/two_mode_tradeoff.h"
#include "tests/r228.h"

namespace howl::tradeoff_test {
namespace {

// An independent formulation, from the test's own wording: each experiment has (omega, phase
// error) free, with xi = (f / omega - omega / f) / (2 tan(-theta)); the largest xi is minimised by
// bisection on it, and for each trial value feasibility is decided by sweeping the highest omega
// over a fine grid that is then refined, going down the chain from the lowest phi and keeping the
// smallest xi that fits (a smaller xi never hurts those that follow). Nothing is shared with the
// code under test but the data.
class SweepTradeoff {
 public:
  SweepTradeoff(std::vector<Experiment> experiments, double tolerance_deg)
      : experiments_(std::move(experiments)), tolerance_deg_(tolerance_deg) {
    std::sort(experiments_.begin(), experiments_.end(),
              [](const auto& a, const auto& b) { return a.phi < b.phi; });
  }

  // Smallest largest xi with every omega in [top / (1 + spread), top]; infinite if none.
  double LargestXi(double top, double spread) const {
    const double bottom = top / (1.0 + spread);
    double xi = 0.0;
    for (const Experiment& e : experiments_) {
      const double lag = -e.phase_deg * M_PI / 180.0;
      const double tolerance = tolerance_deg_ * M_PI / 180.0;
      const double f = e.frequency_hz;
      // xi as a function of omega at one phase falls with omega (p lags q in every experiment).
      const auto xi_at = [&](double omega, double angle) {
        return (f / omega - omega / f) / (2.0 * std::tan(angle));
      };
      const double least = std::max(xi, xi_at(std::min(top, f), lag + tolerance));
      const double most = xi_at(bottom, lag - tolerance);
      if (!(most >= least)) return std::numeric_limits<double>::infinity();
      xi = least;
    }
    return xi;
  }

  double Minimise(double spread) const {
    double lo = 80.0, hi = 250.0, best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 12; ++round) {
      double best_top = lo;
      const int n = 4000;
      for (int k = 0; k <= n; ++k) {
        const double top = lo + (hi - lo) * k / n;
        const double value = LargestXi(top, spread);
        if (value < best) {
          best = value;
          best_top = top;
        }
      }
      const double step = (hi - lo) / n;
      if (round == 0 || best_top != lo) {
        lo = std::max(80.0, best_top - 3 * step);
        hi = std::min(250.0, best_top + 3 * step);
      }
    }
    return best;
  }

 private:
  std::vector<Experiment> experiments_;
  double tolerance_deg_;
};

TEST(TradeoffTest, AgreesWithIndependentOptimisationAtTenSpreads) {
  FamilyProblem problem{.experiments = R228()};
  const SweepTradeoff sweep(R228(), problem.test.phase_tolerance_deg);
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 10; ++k) {
    const double spread = 0.02 + 0.02 * k;
    const TradeoffPoint point = ComputeTradeoff(problem, spread);
    const double expected = sweep.Minimise(spread);
    EXPECT_TRUE(point.exact);
    ASSERT_EQ(point.xi_max.has_value(), std::isfinite(expected)) << spread;
    if (!point.xi_max) continue;
    EXPECT_NEAR(*point.xi_max, expected, 1e-6) << spread;
    EXPECT_LE(*point.xi_max, before);
    before = *point.xi_max;
  }
}

// A member exists just above the curve and none just below it.
TEST(TradeoffTest, CurveIsTheEdgeOfTheFamily) {
  FamilyProblem problem{.experiments = R228()};
  for (const double spread : {0.16, 0.18, 0.2}) {
    const TradeoffPoint point = ComputeTradeoff(problem, spread);
    ASSERT_TRUE(point.xi_max.has_value());
    problem.test.omega_spread_max = spread;
    problem.test.xi_max = *point.xi_max * (1.0 + 1e-3);
    EXPECT_EQ(EnumerateMembers(problem, 10, 1, 1).members.size(), 10u);
    problem.test.xi_max = *point.xi_max * (1.0 - 1e-5);
    EXPECT_TRUE(EnumerateMembers(problem, 10, 1, 1).members.empty());
  }
}

// Two modes: two algorithms that share no step. One follows the chain of phi upwards and takes the
// least xi that fits each window, over a search in window and M; the other is an interior-point
// search over all parameters at once, from several members.
TEST(TradeoffTest, TwoModesByTwoAlgorithmsAtTenSpreads) {
  FamilyProblem problem{.experiments = R228()};
  for (std::size_t i = 0; i < 4; ++i) problem.experiments[i].lines = {{750.0, 10.0}};
  problem.model.modes = 2;
  problem.domain[ParameterKind::kOmega].lo = 150.0;
  problem.domain[ParameterKind::kXi].lo = 0.02;
  problem.domain[ParameterKind::kM].hi = 5000.0;
  problem.test.second_crossing_tolerance_deg = 30.0;
  problem.test.second_crossing_gain_min = 0.0;  // the first algorithm does not know it
  std::vector<double> spreads;
  for (int k = 0; k < 10; ++k) spreads.push_back(0.16 + 0.01 * k);
  const std::vector<TradeoffPoint> points = ComputeTradeoff(problem, spreads, 2, 1);
  for (std::size_t k = 0; k < spreads.size(); ++k) {
    FamilyProblem at = problem;
    at.test.omega_spread_max = spreads[k];
    at.test.xi_max = std::numeric_limits<double>::infinity();
    ASSERT_TRUE(HasGreedyTradeoff(at));
    const std::optional<double> chain = GreedySmallestXi(at);
    ASSERT_TRUE(chain && points[k].xi_max) << spreads[k];
    EXPECT_NEAR(*points[k].xi_max, *chain, 1e-6) << spreads[k];
  }
}

TEST(TradeoffTest, TwoModesBySearchIsMarkedAndNeedsNoMoreXi) {
  FamilyProblem problem{.experiments = R228Reliable()};
  const TradeoffPoint one = ComputeTradeoff(problem, 0.03);
  problem.model.modes = 2;
  const TradeoffPoint two = ComputeTradeoff(problem, 0.03);
  ASSERT_TRUE(one.xi_max && two.xi_max);
  EXPECT_FALSE(two.exact);
  EXPECT_LT(*two.xi_max, *one.xi_max * 1.02);
}

}  // namespace
}  // namespace howl::tradeoff_test
