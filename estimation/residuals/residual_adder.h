// What one residual sees of the joint problem while it adds its blocks.
#ifndef HOWL_ESTIMATION_RESIDUALS_RESIDUAL_ADDER_H_
#define HOWL_ESTIMATION_RESIDUALS_RESIDUAL_ADDER_H_

#include <string>
#include <vector>

#include "estimation/log_parameters.h"
#include "estimation/residuals/problem_blocks.h"
#include "estimation/residuals/registry.h"

namespace howl {

class ResidualAdder {
 public:
  // References, which outlive this object.
  ResidualAdder(ResidualKind kind, const ResidualSet& residuals, ProblemBlocks& blocks)
      : kind_(kind), residuals_(residuals), blocks_(blocks) {}

  // True where the config lets the residual act on the experiment.
  bool ActsOn(int experiment) const;

  const ResidualSpec& Spec() const { return residuals_[kind_]; }
  const Experiment& ExperimentAt(int i) const {
    return blocks_.experiments[static_cast<std::size_t>(i)];
  }
  const ModelSpec& Model() const { return blocks_.model; }
  bool HasTwoModes() const { return blocks_.model.modes == 2; }
  SecondMode SecondModeOfModel() const {
    return {blocks_.model.harmonic_ratio, blocks_.model.second_mode_relative};
  }

  // Indices of parameter blocks, in the order of log_parameters.h.
  int ParameterIndex(ParameterKind kind, int experiment) const {
    return blocks_.ParameterIndex(kind, experiment);
  }
  std::vector<int> AcousticBlocks(int experiment, bool full) const;
  std::vector<int> LoopBlocks(int experiment) const;

  const ParameterBlock& ParameterAt(int index) const {
    return blocks_.parameters[static_cast<std::size_t>(index)];
  }
  // The index of a parameter that the residual brings.
  int AddParameter(ParameterBlock block);
  // A common value of that kind, about which the experiments' own scatter.
  int AddMean(ParameterKind kind, double initial_log);

  // Adds a block for experiment `owner`, whose reliability weighs it; takes `cost`. `suffix` ends
  // the block's label.
  ResidualBlock& Add(int owner, ceres::CostFunction* cost, std::vector<int> parameters,
                     const std::string& suffix = "");

 private:
  ResidualKind kind_;
  const ResidualSet& residuals_;
  ProblemBlocks& blocks_;
};

// " 750 Hz", the suffix of a block that belongs to a frequency.
std::string FrequencySuffix(double frequency_hz);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_RESIDUAL_ADDER_H_
