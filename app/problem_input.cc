#include "app/problem_input.h"

#include <utility>

namespace howl {

std::vector<Experiment> LoadExperiments(const Config& config, const Options& /*options*/) {
  std::vector<Experiment> experiments;
  for (const ExperimentConfig& each : config.experiments) {
    experiments.push_back(each.experiment);
  }
  return experiments;
}

FamilyProblem MakeFamilyProblem(const Config& config, std::vector<Experiment> experiments) {
  FamilyProblem problem;
  problem.experiments = std::move(experiments);
  problem.model = config.model;
  problem.test = config.family.test;
  const ModelSpec defaults = DefaultModelSpec();
  for (const ParameterKind kind : kParameterKinds) {
    const ParameterSpec& spec = config.model[kind];
    if (spec.min != defaults[kind].min) problem.domain[kind].lo = spec.min;
    if (spec.max != defaults[kind].max) problem.domain[kind].hi = spec.max;
  }
  return problem;
}

}  // namespace howl
