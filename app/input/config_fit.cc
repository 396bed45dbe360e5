#include "app/input/config_fit.h"

#include <cmath>

#include "app/command_line/negative_answer.h"
#include "io/user_error.h"

namespace howl {

JointProblem MakeJointProblem(const Config& config, const std::vector<Experiment>& experiments) {
  JointProblem problem(experiments, config.model, config.residuals);
  if (problem.residuals().empty()) {
    const LocatedMember* const residuals = config.tree.Find("residuals");
    throw UserError(config.source.string(), residuals != nullptr ? residuals->key_line : 1,
                    "residuals",
                    "none of those that are switched on acts on these experiments, expected at "
                    "least one that does");
  }
  return problem;
}

JointFit SolveConfig(const Config& config, const Options& options, const JointProblem& problem) {
  JointFit fit = SolveJoint(problem, config.solver, options.seed, options.threads);
  if (std::isnan(fit.cost)) {
    throw NegativeAnswer(config.source.string() + ": the fit did not converge: " +
                         fit.termination.substr(fit.termination.find(": ") + 2));
  }
  return fit;
}

}  // namespace howl
