// What a joint problem is made of: the parameters of all experiments, and the residual blocks on
// them. Each parameter is a block of size one holding the natural logarithm of a positive quantity
// in its natural unit (omega_hz, xi, N, M or M / N, tau_s), shared by all experiments or private to
// one.
#ifndef HOWL_ESTIMATION_RESIDUALS_PROBLEM_BLOCKS_H_
#define HOWL_ESTIMATION_RESIDUALS_PROBLEM_BLOCKS_H_

#include <ceres/cost_function.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/parameters.h"
#include "estimation/residual_spec.h"

namespace howl {

inline constexpr int kShared = -1;

struct ParameterBlock {
  std::string name;  // "exp1.xi"; "M" when shared; "omega_hz_mean"
  int experiment = kShared;
  ParameterKind kind = ParameterKind::kOmega;
  bool is_mean = false;  // the common value of a prior
  // True for a nuisance parameter: how far the level of q's own noise moves the experiment's
  // transfer, in standard deviations (estimation/analysis/transfer/transfer_point_residual.h). It
  // enters as it is, where model parameters enter as logarithms. These blocks come last.
  bool is_q_noise = false;
  double min_log = 0.0;
  double max_log = 0.0;
  double initial_log = 0.0;  // start number 0
  bool fixed = false;
};

// One residual block, for reports: what it is, whose, and its place in the stacked residuals.
struct ResidualBlock {
  ResidualKind kind;
  int experiment = kShared;
  std::string label;  // "gain_equality exp1", "second_crossing exp1 750 Hz"
  std::unique_ptr<ceres::CostFunction> cost;
  std::vector<int> parameters;  // indices into ProblemBlocks::parameters
  double weight = 1.0;          // includes unreliable_weight
  LossKind loss = LossKind::kNone;
  double loss_scale = 1.0;
};

struct ProblemBlocks {
  std::vector<Experiment> experiments;
  ModelSpec model;
  std::vector<ParameterBlock> parameters;
  std::vector<ResidualBlock> residuals;
  // For each kind, the index of each experiment's block; empty for a kind that no model uses.
  std::array<std::vector<int>, kNumParameterKinds> index;

  // The index of the block that holds `kind` for `experiment`: its own, or the shared one.
  int ParameterIndex(ParameterKind kind, int experiment) const;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_PROBLEM_BLOCKS_H_
