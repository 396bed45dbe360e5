#include "estimation/residuals/residual_adder.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/residuals/search_range.h"

namespace howl {

int ProblemBlocks::ParameterIndex(ParameterKind kind, int experiment) const {
  const std::vector<int>& of_kind = index[static_cast<std::size_t>(kind)];
  CHECK(!of_kind.empty()) << "no parameter " << ParameterName(kind);
  return of_kind[experiment == kShared ? 0 : static_cast<std::size_t>(experiment)];
}

bool ResidualAdder::ActsOn(int i) const {
  const ResidualSpec& spec = Spec();
  const Experiment& experiment = ExperimentAt(i);
  if (!spec.enabled || spec.weight == 0.0) return false;
  if (!spec.experiments.empty()) {
    return std::ranges::find(spec.experiments, experiment.name) != spec.experiments.end();
  }
  return experiment.reliable || !DefinitionOf(kind_).reliable_only;
}

std::vector<int> ResidualAdder::AcousticBlocks(int experiment, bool full) const {
  std::vector<int> blocks = {ParameterIndex(ParameterKind::kOmega, experiment),
                             ParameterIndex(ParameterKind::kXi, experiment),
                             ParameterIndex(ParameterKind::kN, experiment)};
  if (full) {
    const ParameterKind second =
        Model().second_mode_relative ? ParameterKind::kMOverN : ParameterKind::kM;
    blocks.push_back(ParameterIndex(second, experiment));
  }
  return blocks;
}

std::vector<int> ResidualAdder::LoopBlocks(int experiment) const {
  std::vector<int> blocks = AcousticBlocks(experiment, HasTwoModes());
  blocks.push_back(ParameterIndex(ParameterKind::kTau, experiment));
  return blocks;
}

int ResidualAdder::AddParameter(ParameterBlock block) {
  blocks_.parameters.push_back(std::move(block));
  return static_cast<int>(blocks_.parameters.size()) - 1;
}

int ResidualAdder::AddMean(ParameterKind kind, double initial_log) {
  const SearchRange range = SearchRails(blocks_.experiments).RangeOf(kind, Model()[kind]);
  ParameterBlock mean;
  mean.name = std::string(ParameterName(kind)) + "_mean";
  mean.kind = kind;
  mean.is_mean = true;
  mean.min_log = std::log(range.min);
  mean.max_log = std::log(range.max);
  mean.initial_log = initial_log;
  return AddParameter(std::move(mean));
}

ResidualBlock& ResidualAdder::Add(int owner, ceres::CostFunction* cost, std::vector<int> parameters,
                                  const std::string& suffix) {
  const ResidualSpec& spec = Spec();
  const Experiment& experiment = ExperimentAt(owner);
  ResidualBlock block;
  block.kind = kind_;
  block.experiment = owner;
  block.label = std::string(ResidualName(kind_)) + " " + experiment.name + suffix;
  block.cost.reset(cost);
  block.parameters = std::move(parameters);
  block.weight = spec.weight * (experiment.reliable ? 1.0 : residuals_.unreliable_weight);
  block.loss = spec.loss;
  block.loss_scale = spec.loss_scale;
  CHECK_EQ(block.parameters.size(), block.cost->parameter_block_sizes().size()) << block.label;
  blocks_.residuals.push_back(std::move(block));
  return blocks_.residuals.back();
}

std::string FrequencySuffix(double frequency_hz) {
  return " " + std::to_string(std::lround(frequency_hz)) + " Hz";
}

}  // namespace howl
