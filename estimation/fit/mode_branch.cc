#include "estimation/fit/mode_branch.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "estimation/fit/two_mode_solve.h"
#include "estimation/parallel.h"
#include "model/loop/second_mode.h"

namespace howl {
namespace {

// How far down from the cycle's frequency to its r-th part omega starts.
constexpr double kDeepest = 0.9;

// omega, N and the second mode of one experiment on the other branch.
LoopModel OtherModel(const Experiment& experiment, LoopModel model, double depth) {
  const double f = experiment.frequency_hz;
  const double r = model.harmonic_ratio;
  const double phase_rad = WrapDeg(experiment.phase_deg) * kRadPerDeg;
  // Both coefficients are positive where y_r <= xi t <= y.
  const double top = OmegaFromDetuning(f, model.xi * std::tan(-phase_rad));
  model.omega_hz = top * std::pow(r, -depth);
  const ModeCoefficients mode =
      CoefficientsFromResponse(f, model.omega_hz, model.xi, r, phase_rad, experiment.gain);
  if (mode.N > 0.0 && mode.M > 0.0) {
    model.N = mode.N;
    model.M = mode.M;
  }
  return model;
}

double LogOf(ParameterKind kind, const LoopModel& model) {
  switch (kind) {
    case ParameterKind::kOmega:
      return std::log(model.omega_hz);
    case ParameterKind::kXi:
      return std::log(model.xi);
    case ParameterKind::kN:
      return std::log(model.N);
    case ParameterKind::kM:
      return std::log(model.M);
    case ParameterKind::kMOverN:
      return std::log(model.M / model.N);
    case ParameterKind::kTau:
      return std::log(model.tau_s);
  }
  LOG(FATAL) << "unknown parameter kind";
}

}  // namespace

double LargestSecondModeShare(std::span<const Experiment> experiments,
                              std::span<const LoopModel> models) {
  CHECK_EQ(experiments.size(), models.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    largest =
        std::max(largest, SecondModeShare(models[i].Loop().acoustics, experiments[i].frequency_hz));
  }
  return largest;
}

std::vector<double> OtherBranchStart(const JointProblem& problem, std::vector<double> start,
                                     double depth) {
  std::vector<LoopModel> models = problem.Models(start);
  for (std::size_t i = 0; i < models.size(); ++i) {
    models[i] = OtherModel(problem.experiments()[i], models[i], depth);
  }
  for (std::size_t k = 0; k < start.size(); ++k) {
    const ParameterBlock& block = problem.parameters()[k];
    const bool moves = block.kind != ParameterKind::kXi && block.kind != ParameterKind::kTau;
    if (block.fixed || block.is_q_noise || !moves) continue;
    // What experiments share, or scatter about, starts at their mean.
    double log = 0.0;
    if (block.experiment == kShared) {
      for (const LoopModel& model : models) {
        log += LogOf(block.kind, model) / static_cast<double>(models.size());
      }
    } else {
      log = LogOf(block.kind, models[static_cast<std::size_t>(block.experiment)]);
    }
    start[k] = std::clamp(log, block.min_log, block.max_log);
  }
  return start;
}

BranchComparison CompareBranches(const JointProblem& problem, const ResidualSet& residuals,
                                 const JointFit& fit, const SolverSpec& solver, std::uint64_t seed,
                                 int threads) {
  CHECK_EQ(problem.model().modes, 2);
  ResidualSet without = residuals;
  without[ResidualKind::kSecondModeMinor].enabled = false;
  ResidualSet with = residuals;
  with[ResidualKind::kSecondModeMinor].enabled = true;
  const JointProblem free(problem.experiments(), problem.model(), without);
  BranchComparison comparison;
  comparison.share_max = residuals[ResidualKind::kSecondModeMinor].center;
  comparison.fit = {JointCost(free, fit.logs),
                    LargestSecondModeShare(problem.experiments(), fit.models), fit.models};
  const bool on_papers = comparison.fit.IsPapers(comparison.share_max);
  std::vector<std::vector<double>> starts;
  for (int number = 0; number < solver.starts; ++number) {
    const std::vector<double> start = problem.Start(number, seed);
    const double depth = kDeepest * (number + 0.5) / solver.starts;
    starts.push_back(on_papers ? OtherBranchStart(problem, start, depth) : start);
  }
  // From the paper's branch the other is reached without the residual, and the other way round the
  // residual leads back.
  const JointProblem held(problem.experiments(), problem.model(), on_papers ? without : with);
  std::vector<std::optional<ModeBranch>> found(starts.size());
  RunUnits(starts.size(), threads, [&](std::size_t k) {
    const JointFit one = SolveJointFrom(held, solver, {starts[k]}, 1);
    const ModeBranch branch{JointCost(free, one.logs),
                            LargestSecondModeShare(problem.experiments(), one.models), one.models};
    const bool there = branch.IsPapers(comparison.share_max) != on_papers;
    if (one.converged && there) found[k] = branch;
  });
  for (const std::optional<ModeBranch>& branch : found) {
    if (branch && (!comparison.other || branch->cost < comparison.other->cost)) {
      comparison.other = branch;
    }
  }
  return comparison;
}

}  // namespace howl
