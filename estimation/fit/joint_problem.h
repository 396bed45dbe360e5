// The joint fit: all experiments in one ceres::Problem.
//
//   minimise over all parameters  1/2 sum_b weight_b loss_b(|residual_b|^2)
//
// with the residuals of estimation/residuals/ (equations (1a), (1b), (5a) to (5c) and the
// qualitative conditions of section 3.3). Each parameter is a block of size one holding the natural
// logarithm of a positive quantity in its natural unit (omega_hz, xi, N, M or M / N, tau_s), shared
// by all experiments or private to one. omega_prior and tau_prior add the common value about which
// experiments scatter as a parameter of its own. A transfer adds one unknown of its record, a
// nuisance parameter that no report names; intervals are those with it free.
#ifndef HOWL_ESTIMATION_FIT_JOINT_PROBLEM_H_
#define HOWL_ESTIMATION_FIT_JOINT_PROBLEM_H_

#include <ceres/cost_function.h>
#include <ceres/problem.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "estimation/analysis/experiment.h"
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
  // transfer, in standard deviations (estimation/residuals/transfer_point.h). It enters as it is,
  // where model parameters enter as logarithms. These blocks come last.
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
  std::vector<int> parameters;  // indices into JointProblem::parameters()
  double weight = 1.0;          // includes unreliable_weight
  LossKind loss = LossKind::kNone;
  double loss_scale = 1.0;
};

class JointProblem {
 public:
  // CHECKs that there is an experiment and that the specs are consistent (min < max).
  JointProblem(std::vector<Experiment> experiments, const ModelSpec& model,
               const ResidualSet& residuals);

  const std::vector<Experiment>& experiments() const { return experiments_; }
  const ModelSpec& model() const { return model_; }
  const std::vector<ParameterBlock>& parameters() const { return parameters_; }
  const std::vector<ResidualBlock>& residuals() const { return residuals_; }

  // The index of the block that holds `kind` for `experiment`: its own, or the shared one.
  int ParameterIndex(ParameterKind kind, int experiment) const;

  // Adds a residual block for data that this class does not know, such as transfers. `parameters`
  // are indices from ParameterIndex.
  void AddResidual(ResidualBlock block);

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
  void AddMean(ResidualKind prior, ParameterKind kind, const ResidualSet& residuals);
  void AddEqualities(int experiment, const ResidualSet& residuals);
  void AddSecondMode(int experiment, const ResidualSet& residuals);
  void AddQNoise(const ResidualSet& residuals);
  void AddTransfer(int experiment, int q_noise, const ResidualSet& residuals);
  void AddXiOrder(const ResidualSet& residuals);
  void Add(const ResidualSet& residuals, ResidualKind kind, int experiment,
           ceres::CostFunction* cost, std::vector<int> parameters,
           const std::string& label_suffix = "");
  std::vector<int> AcousticBlocks(int experiment, bool full) const;
  std::vector<int> LoopBlocks(int experiment) const;

  std::vector<Experiment> experiments_;
  ModelSpec model_;
  std::vector<ParameterBlock> parameters_;
  // For each kind, the index of each experiment's block; empty for a kind that no model uses.
  std::array<std::vector<int>, kNumParameterKinds> index_;
  std::vector<ResidualBlock> residuals_;
};

// True where `spec` acts on the experiment. limit_cycle_gain and second_crossing_gain act on
// reliable experiments alone unless they name others, because the flame slope of an unreliable
// record is not to be trusted.
bool ActsOn(const ResidualSet& residuals, ResidualKind kind, const Experiment& experiment);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_JOINT_PROBLEM_H_
