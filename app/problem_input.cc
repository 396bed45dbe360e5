#include "app/problem_input.h"

namespace howl {

std::vector<Experiment> LoadExperiments(const Config& config, const Options& /*options*/) {
  std::vector<Experiment> experiments;
  for (const ExperimentConfig& each : config.experiments) {
    experiments.push_back(each.experiment);
  }
  return experiments;
}

}  // namespace howl
