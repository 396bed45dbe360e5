#include "estimation/health/mistake_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "estimation/health/mistakes.h"
#include "estimation/health/number_words.h"
#include "estimation/parallel.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

constexpr std::size_t kWorst = 3;  // experiments that are tried alone
constexpr int kStarts = 3;

struct Trial {
  const Mistake* mistake = nullptr;
  std::vector<Experiment> experiments;
  int alone = kShared;  // the experiment in which it is undone
  double before = 0.0;  // cost of the data as they are, over the residuals that both have
  double after = kInfinity;
};

double CostOf(const JointProblem& problem, const JointFit& fit, int experiment, bool slope_alone) {
  double cost = 0.0;
  for (std::size_t i = 0; i < fit.residuals.size(); ++i) {
    const ResidualBlock& block = problem.residuals()[i];
    if (block.experiment != experiment) continue;
    if (slope_alone && block.kind != ResidualKind::kLimitCycleGain) continue;
    for (const double value : fit.residuals[i].values) cost += 0.5 * block.weight * value * value;
  }
  return cost;
}

std::vector<int> Worst(const JointProblem& problem, const JointFit& fit) {
  std::vector<int> order(problem.experiments().size());
  std::iota(order.begin(), order.end(), 0);
  if (order.size() < 2) return {};
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](int i) { return CostOf(problem, fit, i, false); });
  order.resize(std::min(order.size(), kWorst));
  return order;
}

class Search {
 public:
  Search(const JointProblem& problem, const ResidualSet& residuals, const JointFit& fit,
         const MistakeSearch& search)
      : model_(problem.model()), residuals_(residuals), search_(search) {
    for (Experiment experiment : problem.experiments()) {
      has_transfer_.push_back(!experiment.transfer.empty());
      experiment.transfer.clear();
      experiment.transfer_ellipsoid.reset();
      experiments_.push_back(std::move(experiment));
    }
    solver_ = search.solver;
    if (std::ranges::count(has_transfer_, true) > 0) {
      const JointProblem without(experiments_, model_, residuals_);
      Suspect(without, SolveJoint(without, solver_, search_.seed, search_.threads));
    } else {
      Suspect(problem, fit);
    }
    solver_.starts = std::min(solver_.starts, kStarts);
  }

  Health Findings();

 private:
  void Suspect(const JointProblem& problem, const JointFit& fit) {
    cost_ = fit.cost;
    worst_ = Worst(problem, fit);
    for (int i = 0; i < static_cast<int>(experiments_.size()); ++i) {
      slope_costs_.push_back(CostOf(problem, fit, i, true));
    }
  }
  bool Applies(const Mistake& mistake, std::size_t i) const {
    if (std::ranges::find(search_.recorded, experiments_[i].name) == search_.recorded.end()) {
      return mistake.in_tables;
    }
    return mistake.in_records && !(mistake.in_transfer && has_transfer_[i]);
  }
  void Try(const Mistake& mistake, int alone);
  void Refit(Trial& trial) const;

  ModelSpec model_;
  ResidualSet residuals_;
  MistakeSearch search_;
  SolverSpec solver_;
  std::vector<Experiment> experiments_;
  std::vector<bool> has_transfer_;
  double cost_ = 0.0;
  std::vector<double> slope_costs_;  // of limit_cycle_gain, for each experiment
  std::vector<int> worst_;
  std::vector<Trial> trials_;
};

void Search::Try(const Mistake& mistake, int alone) {
  Trial trial{.mistake = &mistake, .experiments = experiments_, .alone = alone, .before = cost_};
  bool any = false;
  for (int i = 0; i < static_cast<int>(experiments_.size()); ++i) {
    const auto at = static_cast<std::size_t>(i);
    Experiment& experiment = trial.experiments[at];
    if ((alone != kShared && alone != i) || !Applies(mistake, at)) continue;
    const bool had_slope = experiment.flame_slope.has_value();
    if (!mistake.undo(experiment)) continue;
    any = true;
    if (had_slope && !experiment.flame_slope) {
      trial.before -= slope_costs_[at];
    }
  }
  if (any) trials_.push_back(std::move(trial));
}

void Search::Refit(Trial& trial) const {
  const JointProblem problem(trial.experiments, model_, residuals_);
  const JointFit fit = SolveJoint(problem, solver_, search_.seed, 1);
  if (fit.converged) trial.after = fit.cost;
}

Health Search::Findings() {
  if (!(cost_ >= kMuchBetter)) return {};  // a failed fit has none
  const std::vector<Mistake> mistakes = PossibleMistakes(experiments_);
  for (const Mistake& mistake : mistakes) {
    if (mistake.together) Try(mistake, kShared);
    if (!mistake.alone) continue;
    for (const int experiment : worst_) Try(mistake, experiment);
  }
  RunUnits(trials_.size(), search_.threads, [&](std::size_t i) { Refit(trials_[i]); });
  double best = kInfinity;
  const auto much_better = [](const Trial& trial) {
    return trial.before - trial.after > kMuchBetter && trial.after < kMostLeft * trial.before;
  };
  for (const Trial& trial : trials_) {
    if (much_better(trial)) best = std::min(best, trial.after);
  }
  Health health;
  for (const Trial& trial : trials_) {
    if (!much_better(trial) || trial.after > best + kAlike) continue;
    const std::string who = trial.alone == kShared
                                ? std::string()
                                : experiments_[static_cast<std::size_t>(trial.alone)].name;
    health.push_back({FindingKind::kMistake, who, trial.mistake->id, trial.before, trial.after,
                      (who.empty() ? "the data look like " : who + " looks like ") +
                          trial.mistake->text + ": " + trial.mistake->undone +
                          " the cost falls from " + NumberWord(trial.before) + " to " +
                          NumberWord(trial.after)});
  }
  return health;
}

}  // namespace

Health FindMistakes(const JointProblem& problem, const ResidualSet& residuals, const JointFit& fit,
                    const MistakeSearch& search) {
  Health health = Search(problem, residuals, fit, search).Findings();
  for (const Experiment& experiment : problem.experiments()) {
    const double gain = MeasuredLoopGain(experiment);
    if (!(gain > kLargestLoopGain)) continue;
    health.push_back({FindingKind::kMistake, experiment.name, "flame_slope_unit", gain,
                      kLargestLoopGain,
                      experiment.name +
                          " looks like flame_slope or gain in another unit than the "
                          "other, too large: its loop gain at the cycle is " +
                          NumberWord(gain)});
  }
  return health;
}

}  // namespace howl
