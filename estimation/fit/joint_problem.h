// The joint fit: all experiments in one ceres::Problem.
//
//   minimise over all parameters  1/2 sum_b weight_b loss_b(|residual_b|^2)
//
// with the residuals of estimation/residuals/ (equations (1a), (1b), (5a) to (5c) and the
// qualitative conditions of section 3.3), each of which adds its own blocks (residuals/registry.h).
// Parameters are logarithms (residuals/problem_blocks.h). omega_prior and tau_prior add the common
// value about which experiments scatter as a parameter of its own. A transfer adds one unknown of
// its record, a nuisance parameter that no report names; intervals are those with it free.
#ifndef HOWL_ESTIMATION_FIT_JOINT_PROBLEM_H_
#define HOWL_ESTIMATION_FIT_JOINT_PROBLEM_H_

#include <ceres/problem.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"
#include "estimation/residual_spec.h"
#include "estimation/residuals/problem_blocks.h"

namespace howl {

class JointProblem {
 public:
  // CHECKs that there is an experiment and that the specs are consistent (min < max).
  JointProblem(std::vector<Experiment> experiments, const ModelSpec& model,
               const ResidualSet& residuals);

  const std::vector<Experiment>& experiments() const { return blocks_.experiments; }
  const ModelSpec& model() const { return blocks_.model; }
  const std::vector<ParameterBlock>& parameters() const { return blocks_.parameters; }
  const std::vector<ResidualBlock>& residuals() const { return blocks_.residuals; }

  // The index of the block that holds `kind` for `experiment`: its own, or the shared one.
  int ParameterIndex(ParameterKind kind, int experiment) const {
    return blocks_.ParameterIndex(kind, experiment);
  }

  // The start of that number: 0 is the closed form on the data; others scatter it by factors of a
  // few.
  std::vector<double> Start(int number, std::uint64_t seed) const;

  // A Ceres problem over `logs`, which must have parameters().size() entries and outlive it, as
  // must this object.
  std::unique_ptr<ceres::Problem> Build(double* logs) const;

  // The models in natural units, one for each experiment.
  std::vector<LoopModel> Models(const std::vector<double>& logs) const;

 private:
  void AddParameters();
  void AddResiduals(const ResidualSet& residuals);

  ProblemBlocks blocks_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_JOINT_PROBLEM_H_
