#include "estimation/fit/joint_problem.h"

#include <ceres/loss_function.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "estimation/analysis/closed_form.h"
#include "estimation/analysis/transfer.h"
#include "estimation/fit/search_range.h"
#include "estimation/residuals/constant_prior.h"
#include "estimation/residuals/damping_prior.h"
#include "estimation/residuals/gain_equality.h"
#include "estimation/residuals/limit_cycle_gain.h"
#include "estimation/residuals/limit_cycle_phase.h"
#include "estimation/residuals/phase_equality.h"
#include "estimation/residuals/second_crossing.h"
#include "estimation/residuals/second_crossing_gain.h"
#include "estimation/residuals/second_mode_minor.h"
#include "estimation/residuals/transfer_point.h"
#include "estimation/residuals/xi_increasing.h"
#include "estimation/unit_seed.h"

namespace howl {
namespace {

constexpr double kStartXi = 0.1;            // a lightly damped mode
constexpr double kStartMOverN = 0.4;        // the paper's figures 11 and 12 imply about this
constexpr double kMostQNoise = 100.0;       // standard deviations: a guard rail
constexpr double kMaxStartPhaseDeg = 85.0;  // the closed form needs less than 90

ceres::LossFunction* CreateLoss(const ResidualBlock& block) {
  ceres::LossFunction* loss = nullptr;
  switch (block.loss) {
    case LossKind::kNone:
      break;
    case LossKind::kHuber:
      loss = new ceres::HuberLoss(block.loss_scale);
      break;
    case LossKind::kSoftL1:
      loss = new ceres::SoftLOneLoss(block.loss_scale);
      break;
    case LossKind::kCauchy:
      loss = new ceres::CauchyLoss(block.loss_scale);
      break;
    case LossKind::kTukey:
      loss = new ceres::TukeyLoss(block.loss_scale);
      break;
  }
  if (loss == nullptr && block.weight == 1.0) return nullptr;
  return new ceres::ScaledLoss(loss, block.weight, ceres::TAKE_OWNERSHIP);
}

double Clamp(double value, const ParameterBlock& block) {
  return std::clamp(value, block.min_log, block.max_log);
}

double StartValue(ParameterKind kind, const LoopModel& model) {
  switch (kind) {
    case ParameterKind::kOmega:
      return model.omega_hz;
    case ParameterKind::kXi:
      return model.xi;
    case ParameterKind::kN:
      return model.N;
    case ParameterKind::kM:
      return kStartMOverN * model.N;
    case ParameterKind::kMOverN:
      return kStartMOverN;
    case ParameterKind::kTau:
      return model.tau_s;
  }
  LOG(FATAL) << "unknown parameter kind";
}

LoopModel StartModel(Experiment experiment) {
  experiment.phase_deg = std::clamp(experiment.phase_deg, -kMaxStartPhaseDeg, kMaxStartPhaseDeg);
  LoopModel model = ClosedFormMember(experiment, kStartXi);
  model.tau_s =
      DelayFromPhase(experiment.frequency_hz, experiment.phase_deg, experiment.delay_periods);
  return model;
}

// Factor by which a random start may leave the closed form, either way. tau's is small: its
// residual has another minimum every period.
double StartScatter(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kOmega:
      return 1.2;
    case ParameterKind::kXi:
      return 5.0;
    case ParameterKind::kN:
    case ParameterKind::kM:
    case ParameterKind::kMOverN:
      return 5.0;
    case ParameterKind::kTau:
      return 1.1;
  }
  LOG(FATAL) << "unknown parameter kind";
}

}  // namespace

bool ActsOn(const ResidualSet& residuals, ResidualKind kind, const Experiment& experiment) {
  const ResidualSpec& spec = residuals[kind];
  if (!spec.enabled || spec.weight == 0.0) return false;
  if (!spec.experiments.empty()) {
    return std::ranges::find(spec.experiments, experiment.name) != spec.experiments.end();
  }
  const bool asks_slope =
      kind == ResidualKind::kLimitCycleGain || kind == ResidualKind::kSecondCrossingGain;
  return !asks_slope || experiment.reliable;
}

JointProblem::JointProblem(std::vector<Experiment> experiments, const ModelSpec& model,
                           const ResidualSet& residuals)
    : experiments_(std::move(experiments)), model_(model) {
  CHECK(!experiments_.empty());
  CHECK(model_.modes == 1 || model_.modes == 2) << model_.modes;
  AddParameters();
  for (int i = 0; i < static_cast<int>(experiments_.size()); ++i) AddEqualities(i, residuals);
  AddMean(ResidualKind::kOmegaPrior, ParameterKind::kOmega, residuals);
  AddMean(ResidualKind::kTauPrior, ParameterKind::kTau, residuals);
  AddXiOrder(residuals);
  AddQNoise(residuals);
}

void JointProblem::AddParameters() {
  const int num_experiments = static_cast<int>(experiments_.size());
  std::vector<LoopModel> starts;
  for (const Experiment& experiment : experiments_) starts.push_back(StartModel(experiment));
  const SearchRails rails(experiments_);
  const auto add = [&](ParameterKind kind, int experiment, double start) {
    const ParameterSpec& spec =
        experiment == kShared
            ? model_[kind]
            : model_.Of(kind, experiments_[static_cast<std::size_t>(experiment)].name);
    const SearchRange range = rails.RangeOf(kind, spec);
    CHECK(range.min > 0.0 && range.min < range.max) << ParameterName(kind);
    ParameterBlock block;
    block.name = std::string(ParameterName(kind));
    if (experiment != kShared) {
      block.name = experiments_[static_cast<std::size_t>(experiment)].name + "." + block.name;
    }
    block.experiment = experiment;
    block.kind = kind;
    block.min_log = std::log(range.min);
    block.max_log = std::log(range.max);
    block.initial_log = Clamp(std::log(spec.initial.value_or(start)), block);
    block.fixed = spec.fixed;
    parameters_.push_back(std::move(block));
  };
  for (const ParameterKind kind : kParameterKinds) {
    if (!model_.Uses(kind)) continue;
    const int first = static_cast<int>(parameters_.size());
    std::vector<int>& index = index_[static_cast<std::size_t>(kind)];
    index.resize(experiments_.size(), first);
    if (model_[kind].scope == ParameterScope::kShared) {
      double log_sum = 0.0;
      for (const LoopModel& start : starts) log_sum += std::log(StartValue(kind, start));
      add(kind, kShared, std::exp(log_sum / num_experiments));
    } else {
      std::iota(index.begin(), index.end(), first);
      for (int i = 0; i < num_experiments; ++i) {
        add(kind, i, StartValue(kind, starts[static_cast<std::size_t>(i)]));
      }
    }
  }
}

int JointProblem::ParameterIndex(ParameterKind kind, int experiment) const {
  const std::vector<int>& index = index_[static_cast<std::size_t>(kind)];
  CHECK(!index.empty()) << "no parameter " << ParameterName(kind);
  return index[experiment == kShared ? 0 : static_cast<std::size_t>(experiment)];
}

std::vector<int> JointProblem::AcousticBlocks(int experiment, bool full) const {
  std::vector<int> blocks = {ParameterIndex(ParameterKind::kOmega, experiment),
                             ParameterIndex(ParameterKind::kXi, experiment),
                             ParameterIndex(ParameterKind::kN, experiment)};
  if (full) {
    const ParameterKind second =
        model_.second_mode_relative ? ParameterKind::kMOverN : ParameterKind::kM;
    blocks.push_back(ParameterIndex(second, experiment));
  }
  return blocks;
}

std::vector<int> JointProblem::LoopBlocks(int experiment) const {
  std::vector<int> blocks = AcousticBlocks(experiment, model_.modes == 2);
  blocks.push_back(ParameterIndex(ParameterKind::kTau, experiment));
  return blocks;
}

void JointProblem::AddResidual(ResidualBlock block) {
  CHECK_EQ(block.parameters.size(), block.cost->parameter_block_sizes().size()) << block.label;
  residuals_.push_back(std::move(block));
}

void JointProblem::Add(const ResidualSet& residuals, ResidualKind kind, int experiment,
                       ceres::CostFunction* cost, std::vector<int> parameters,
                       const std::string& label_suffix) {
  const ResidualSpec& spec = residuals[kind];
  const Experiment& owner = experiments_[static_cast<std::size_t>(experiment)];
  ResidualBlock block;
  block.kind = kind;
  block.experiment = experiment;
  block.label = std::string(ResidualName(kind)) + " " + owner.name + label_suffix;
  block.cost.reset(cost);
  block.parameters = std::move(parameters);
  block.weight = spec.weight * (owner.reliable ? 1.0 : residuals.unreliable_weight);
  block.loss = spec.loss;
  block.loss_scale = spec.loss_scale;
  AddResidual(std::move(block));
}

void JointProblem::AddEqualities(int i, const ResidualSet& residuals) {
  const Experiment& experiment = experiments_[static_cast<std::size_t>(i)];
  const SecondMode second{model_.harmonic_ratio, model_.second_mode_relative};
  const bool two_modes = model_.modes == 2;
  const auto is_full = [&](ResidualKind kind) {
    return two_modes && residuals[kind].form != EquationForm::kReduced;
  };
  const auto add_acoustic = [&]<typename Functor>(ResidualKind kind, const Functor& functor) {
    using Residual = AcousticResidual<Functor>;
    const bool full = is_full(kind);
    Add(residuals, kind, i,
        full ? Residual::CreateFull(functor, second) : Residual::CreateReduced(functor),
        AcousticBlocks(i, full));
  };
  const auto add_loop = [&](ResidualKind kind, const LimitCyclePhase& functor,
                            const std::string& suffix) {
    Add(residuals, kind, i,
        two_modes ? LimitCyclePhaseResidual::CreateFull(functor, second)
                  : LimitCyclePhaseResidual::CreateReduced(functor),
        LoopBlocks(i), suffix);
  };

  if (ActsOn(residuals, ResidualKind::kGainEquality, experiment)) {
    const double std_relative = experiment.gain_std ? *experiment.gain_std / experiment.gain
                                                    : residuals[ResidualKind::kGainEquality].std;
    add_acoustic(ResidualKind::kGainEquality,
                 GainEquality{experiment.frequency_hz, experiment.gain, std_relative});
  }
  if (ActsOn(residuals, ResidualKind::kPhaseEquality, experiment)) {
    const double std_deg =
        experiment.phase_std_deg.value_or(residuals[ResidualKind::kPhaseEquality].std);
    add_acoustic(ResidualKind::kPhaseEquality,
                 PhaseEquality{experiment.frequency_hz, experiment.phase_deg, std_deg});
  }
  if (ActsOn(residuals, ResidualKind::kLimitCycleGain, experiment) && experiment.flame_slope) {
    add_acoustic(ResidualKind::kLimitCycleGain,
                 LimitCycleGain{experiment.frequency_hz, *experiment.flame_slope,
                                residuals[ResidualKind::kLimitCycleGain].std});
  }
  if (ActsOn(residuals, ResidualKind::kLimitCyclePhase, experiment)) {
    // A cycle that noise drives has the phase of 180 degrees at its long-term frequency, from which
    // that of a record differs by its standard deviation. This concerns the loop and not G, because
    // p = G q holds at whatever frequency the record had.
    const double tau_s =
        DelayFromPhase(experiment.frequency_hz, experiment.phase_deg, experiment.delay_periods);
    add_loop(ResidualKind::kLimitCyclePhase,
             SecondCrossing(experiment.frequency_hz, experiment.frequency_std_hz.value_or(0.0),
                            tau_s, residuals[ResidualKind::kLimitCyclePhase].std),
             "");
  }
  if (two_modes && ActsOn(residuals, ResidualKind::kSecondCrossing, experiment)) {
    const double tau_s =
        DelayFromPhase(experiment.frequency_hz, experiment.phase_deg, experiment.delay_periods);
    for (const ObservedLine& line : experiment.lines) {
      add_loop(ResidualKind::kSecondCrossing,
               SecondCrossing(line.frequency_hz, line.frequency_std_hz, tau_s,
                              residuals[ResidualKind::kSecondCrossing].std),
               " " + std::to_string(std::lround(line.frequency_hz)) + " Hz");
    }
  }
  if (two_modes) AddSecondMode(i, residuals);
  if (ActsOn(residuals, ResidualKind::kDampingPrior, experiment)) {
    Add(residuals, ResidualKind::kDampingPrior, i,
        DampingPrior::Create(residuals[ResidualKind::kDampingPrior].center,
                             residuals[ResidualKind::kDampingPrior].std),
        {ParameterIndex(ParameterKind::kXi, i)});
  }
}

void JointProblem::AddSecondMode(int i, const ResidualSet& residuals) {
  const Experiment& experiment = experiments_[static_cast<std::size_t>(i)];
  const SecondMode second{model_.harmonic_ratio, model_.second_mode_relative};
  if (ActsOn(residuals, ResidualKind::kSecondModeMinor, experiment)) {
    const ResidualSpec& spec = residuals[ResidualKind::kSecondModeMinor];
    Add(residuals, ResidualKind::kSecondModeMinor, i,
        SecondModeMinorResidual::CreateFull({experiment.frequency_hz, spec.center, spec.std},
                                            second),
        AcousticBlocks(i, true));
  }
  if (!ActsOn(residuals, ResidualKind::kSecondCrossingGain, experiment)) return;
  if (!experiment.flame_slope) return;
  for (const ObservedLine& line : experiment.lines) {
    Add(residuals, ResidualKind::kSecondCrossingGain, i,
        LimitCycleGainResidual::CreateFull(
            SecondCrossingGain(line.frequency_hz, *experiment.flame_slope,
                               residuals[ResidualKind::kSecondCrossingGain].std),
            second),
        AcousticBlocks(i, true), " " + std::to_string(std::lround(line.frequency_hz)) + " Hz");
  }
}

// The level of q's noise is one unknown of a record. If each point had such an error of its own,
// fifty of them would leave a seventh of it, but it does not average out.
void JointProblem::AddQNoise(const ResidualSet& residuals) {
  for (int i = 0; i < static_cast<int>(experiments_.size()); ++i) {
    const Experiment& experiment = experiments_[static_cast<std::size_t>(i)];
    if (experiment.transfer.empty() || !ActsOn(residuals, ResidualKind::kTransfer, experiment)) {
      continue;
    }
    ParameterBlock block;
    block.name = experiment.name + ".q_noise";
    block.experiment = i;
    block.is_q_noise = true;
    block.min_log = -kMostQNoise;
    block.max_log = kMostQNoise;
    parameters_.push_back(std::move(block));
    const int index = static_cast<int>(parameters_.size()) - 1;
    AddTransfer(i, index, residuals);
    Add(residuals, ResidualKind::kTransfer, i, QNoiseLevelPrior::Create(), {index}, " q noise");
    residuals_.back().loss = LossKind::kNone;
  }
}

void JointProblem::AddTransfer(int i, int q_noise, const ResidualSet& residuals) {
  const Experiment& experiment = experiments_[static_cast<std::size_t>(i)];
  const bool two_modes = model_.modes == 2;
  const TransferBand band = TransferBandOf(model_, experiment.frequency_hz);
  const double model_std = residuals[ResidualKind::kTransfer].std;
  for (TransferPoint point : experiment.transfer) {
    if (!band.Contains(point.frequency_hz)) continue;
    const double model_variance =
        model_std * model_std * (point.re * point.re + point.im * point.im);
    point.variance_re += model_variance;
    point.variance_im += model_variance;
    ceres::CostFunction* cost =
        two_modes ? TransferPointResidual::CreateFull(
                        point, {model_.harmonic_ratio, model_.second_mode_relative})
                  : TransferPointResidual::CreateReduced(point);
    std::vector<int> blocks = AcousticBlocks(i, two_modes);
    blocks.insert(blocks.begin(), q_noise);
    Add(residuals, ResidualKind::kTransfer, i, cost, std::move(blocks),
        " " + std::to_string(std::lround(point.frequency_hz)) + " Hz");
  }
}

void JointProblem::AddMean(ResidualKind prior, ParameterKind kind, const ResidualSet& residuals) {
  if (model_[kind].scope == ParameterScope::kShared) return;
  std::vector<int> members;
  double log_sum = 0.0;
  for (int i = 0; i < static_cast<int>(experiments_.size()); ++i) {
    if (!ActsOn(residuals, prior, experiments_[static_cast<std::size_t>(i)])) continue;
    members.push_back(i);
    log_sum += parameters_[static_cast<std::size_t>(ParameterIndex(kind, i))].initial_log;
  }
  if (members.size() < 2) return;  // one value scatters about nothing
  ParameterBlock mean;
  mean.name = std::string(ParameterName(kind)) + "_mean";
  mean.kind = kind;
  mean.is_mean = true;
  const SearchRange range = SearchRails(experiments_).RangeOf(kind, model_[kind]);
  mean.min_log = std::log(range.min);
  mean.max_log = std::log(range.max);
  mean.initial_log = log_sum / static_cast<double>(members.size());
  parameters_.push_back(mean);
  const int mean_index = static_cast<int>(parameters_.size()) - 1;
  for (const int i : members) {
    Add(residuals, prior, i, ConstantPrior::Create(residuals[prior].std),
        {ParameterIndex(kind, i), mean_index});
  }
}

void JointProblem::AddXiOrder(const ResidualSet& residuals) {
  if (model_[ParameterKind::kXi].scope == ParameterScope::kShared) return;
  std::vector<int> order;
  for (int i = 0; i < static_cast<int>(experiments_.size()); ++i) {
    if (ActsOn(residuals, ResidualKind::kXiIncreasing, experiments_[static_cast<std::size_t>(i)])) {
      order.push_back(i);
    }
  }
  std::ranges::stable_sort(order, {},
                           [&](int i) { return experiments_[static_cast<std::size_t>(i)].phi; });
  for (std::size_t k = 1; k < order.size(); ++k) {
    // The block belongs to the less reliable of the two.
    const int lower = order[k - 1];
    const int higher = order[k];
    const int owner = experiments_[static_cast<std::size_t>(lower)].reliable ? higher : lower;
    Add(residuals, ResidualKind::kXiIncreasing, owner,
        XiIncreasing::Create(residuals[ResidualKind::kXiIncreasing].std),
        {ParameterIndex(ParameterKind::kXi, lower), ParameterIndex(ParameterKind::kXi, higher)});
  }
}

std::vector<double> JointProblem::Start(int number, std::uint64_t seed) const {
  std::vector<double> logs;
  std::mt19937_64 generator(UnitSeed(seed, "start", static_cast<std::uint64_t>(number)));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const ParameterBlock& block : parameters_) {
    const double scatter = uniform(generator) * std::log(StartScatter(block.kind));
    const bool stay = number == 0 || block.fixed || block.is_q_noise;
    logs.push_back(stay ? block.initial_log : Clamp(block.initial_log + scatter, block));
  }
  return logs;
}

std::unique_ptr<ceres::Problem> JointProblem::Build(double* logs) const {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  auto problem = std::make_unique<ceres::Problem>(options);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    problem->AddParameterBlock(logs + i, 1);
    if (parameters_[i].fixed) {
      problem->SetParameterBlockConstant(logs + i);
      continue;
    }
    problem->SetParameterLowerBound(logs + i, 0, parameters_[i].min_log);
    problem->SetParameterUpperBound(logs + i, 0, parameters_[i].max_log);
  }
  for (const ResidualBlock& block : residuals_) {
    std::vector<double*> pointers;
    for (const int index : block.parameters) pointers.push_back(logs + index);
    problem->AddResidualBlock(block.cost.get(), CreateLoss(block), pointers);
  }
  return problem;
}

std::vector<LoopModel> JointProblem::Models(const std::vector<double>& logs) const {
  CHECK_EQ(logs.size(), parameters_.size());
  std::vector<LoopModel> models;
  for (int i = 0; i < static_cast<int>(experiments_.size()); ++i) {
    const auto value = [&](ParameterKind kind) {
      return std::exp(logs[static_cast<std::size_t>(ParameterIndex(kind, i))]);
    };
    LoopModel model{.omega_hz = value(ParameterKind::kOmega),
                    .xi = value(ParameterKind::kXi),
                    .N = value(ParameterKind::kN),
                    .tau_s = value(ParameterKind::kTau),
                    .harmonic_ratio = model_.harmonic_ratio};
    if (model_.modes == 2) {
      model.M = model_.second_mode_relative ? model.N * value(ParameterKind::kMOverN)
                                            : value(ParameterKind::kM);
    }
    models.push_back(model);
  }
  return models;
}

}  // namespace howl
