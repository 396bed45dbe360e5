// The joint fit of a config.
#ifndef HOWL_APP_INPUT_CONFIG_FIT_H_
#define HOWL_APP_INPUT_CONFIG_FIT_H_

#include <vector>

#include "app/command_line/options.h"
#include "estimation/analysis/loop/experiment.h"
#include "estimation/fit/joint_fit.h"
#include "estimation/fit/joint_problem.h"
#include "io/config/config.h"

namespace howl {

// The joint fit's problem. Throws UserError when the config leaves no residual to fit.
JointProblem MakeJointProblem(const Config& config, const std::vector<Experiment>& experiments);

// Throws NegativeAnswer when no start has finite residuals.
JointFit SolveConfig(const Config& config, const Options& options, const JointProblem& problem);

}  // namespace howl

#endif  // HOWL_APP_INPUT_CONFIG_FIT_H_
