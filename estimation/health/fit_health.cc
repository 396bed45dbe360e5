#include "estimation/health/fit_health.h"

#include <glog/logging.h>

#include <algorithm>
#include <boost/math/distributions/poisson.hpp>
#include <cmath>
#include <map>
#include <string>

#include "estimation/health/number_words.h"

namespace howl {
namespace {

constexpr double kBeyondThree = 0.0026998;  // the normal distribution's share beyond 3, two sides
constexpr double kRare = 1e-3;

const std::string& NameOf(const JointProblem& problem, int experiment) {
  static const std::string all;
  return experiment == kShared ? all
                               : problem.experiments()[static_cast<std::size_t>(experiment)].name;
}

void AddParameters(const JointProblem& problem, const JointFit& fit, Health& health) {
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& parameter = fit.parameters[i];
    if (!parameter.at_bound && !parameter.at_guard_rail) continue;
    const std::string at = parameter.name + " stands at " + NumberWord(parameter.value, 4);
    Finding finding{FindingKind::kBound, NameOf(problem, problem.parameters()[i].experiment),
                    parameter.name,      parameter.value,
                    parameter.bound,     at + ", its bound"};
    if (parameter.at_guard_rail) {
      finding.kind = FindingKind::kGuardRail;
      finding.text = at +
                     ", where the search ends and no config set a bound: the data and this model "
                     "contradict each other, and the other parameters mean nothing";
    }
    health.push_back(std::move(finding));
  }
}

struct Tally {
  std::size_t points = 0;
  std::size_t beyond = 0;
};

void AddResiduals(const JointProblem& problem, const JointFit& fit, Health& health) {
  CHECK_EQ(problem.residuals().size(), fit.residuals.size());
  std::map<int, Tally> transfers;
  for (std::size_t i = 0; i < fit.residuals.size(); ++i) {
    const ResidualBlock& block = problem.residuals()[i];
    for (const double raw : fit.residuals[i].values) {
      const double value = raw * std::sqrt(block.weight);
      const bool beyond = std::abs(value) > kLargeResidual;
      if (block.kind == ResidualKind::kTransfer) {
        Tally& tally = transfers[block.experiment];
        ++tally.points;
        tally.beyond += beyond ? 1 : 0;
      } else if (beyond) {
        health.push_back({FindingKind::kResidual, NameOf(problem, block.experiment), block.label,
                          value, kLargeResidual,
                          block.label + " is missed by " + NumberWord(std::abs(value)) +
                              " standard deviations"});
      }
    }
  }
  for (const auto& [experiment, tally] : transfers) {
    if (tally.beyond == 0) continue;
    const boost::math::poisson_distribution<> chance(kBeyondThree *
                                                     static_cast<double>(tally.points));
    const double as_many =
        boost::math::cdf(boost::math::complement(chance, static_cast<double>(tally.beyond - 1)));
    if (as_many > kRare) continue;
    const std::string& name = NameOf(problem, experiment);
    const auto share = static_cast<double>(tally.beyond) / static_cast<double>(tally.points);
    health.push_back({FindingKind::kResidual, name, "transfer " + name, share, kBeyondThree,
                      "transfer " + name + ": " + NumberWord(100.0 * share) +
                          " % of its points are missed by more than 3 standard deviations, chance "
                          "misses 0.27 %"});
  }
}

}  // namespace

Health CheckFit(const JointProblem& problem, const JointFit& fit) {
  Health health;
  AddParameters(problem, fit, health);
  const bool on_guard_rail = std::ranges::any_of(
      health, [](const Finding& finding) { return finding.kind == FindingKind::kGuardRail; });
  if (!fit.converged && !on_guard_rail) {
    health.insert(health.begin(), {FindingKind::kNotConverged,
                                   {},
                                   "solver",
                                   static_cast<double>(fit.starts_converged),
                                   static_cast<double>(fit.starts),
                                   "no start converged: " + fit.termination});
  }
  AddResiduals(problem, fit, health);
  return health;
}

}  // namespace howl
