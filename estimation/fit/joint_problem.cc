#include "estimation/fit/joint_problem.h"

#include <ceres/loss_function.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/residuals/registry.h"
#include "estimation/residuals/residual_adder.h"
#include "estimation/residuals/search_range.h"
#include "estimation/unit_seed.h"

namespace howl {
namespace {

constexpr double kStartXi = 0.1;            // a lightly damped mode
constexpr double kStartMOverN = 0.4;        // the paper's figures 11 and 12 imply about this
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
  return ClosedFormMember(experiment, kStartXi);
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

JointProblem::JointProblem(std::vector<Experiment> experiments, const ModelSpec& model,
                           const ResidualSet& residuals)
    : blocks_{.experiments = std::move(experiments), .model = model} {
  CHECK(!blocks_.experiments.empty());
  CHECK(model.modes == 1 || model.modes == 2) << model.modes;
  AddParameters();
  AddResiduals(residuals);
}

void JointProblem::AddResiduals(const ResidualSet& residuals) {
  const int num_experiments = static_cast<int>(blocks_.experiments.size());
  const auto wanted = [&](const ResidualDefinition& definition) {
    return !definition.needs_two_modes || blocks_.model.modes == 2;
  };
  for (int i = 0; i < num_experiments; ++i) {
    for (const ResidualKind kind : kResidualKinds) {
      const ResidualDefinition& definition = DefinitionOf(kind);
      ResidualAdder adder(kind, residuals, blocks_);
      if (definition.add_to && wanted(definition) && adder.ActsOn(i)) definition.add_to(adder, i);
    }
  }
  for (const ResidualKind kind : kResidualKinds) {
    const ResidualDefinition& definition = DefinitionOf(kind);
    if (!definition.add_across || !wanted(definition)) continue;
    ResidualAdder adder(kind, residuals, blocks_);
    std::vector<int> acted_on;
    for (int i = 0; i < num_experiments; ++i) {
      if (adder.ActsOn(i)) acted_on.push_back(i);
    }
    definition.add_across(adder, acted_on);
  }
}

void JointProblem::AddParameters() {
  const int num_experiments = static_cast<int>(blocks_.experiments.size());
  std::vector<LoopModel> starts;
  for (const Experiment& experiment : blocks_.experiments) starts.push_back(StartModel(experiment));
  const SearchRails rails(blocks_.experiments);
  const auto add = [&](ParameterKind kind, int experiment, double start) {
    const ParameterSpec& spec =
        experiment == kShared
            ? blocks_.model[kind]
            : blocks_.model.Of(kind,
                               blocks_.experiments[static_cast<std::size_t>(experiment)].name);
    const SearchRange range = rails.RangeOf(kind, spec);
    CHECK(range.min > 0.0 && range.min < range.max) << ParameterName(kind);
    ParameterBlock block;
    block.name = std::string(ParameterName(kind));
    if (experiment != kShared) {
      block.name =
          blocks_.experiments[static_cast<std::size_t>(experiment)].name + "." + block.name;
    }
    block.experiment = experiment;
    block.kind = kind;
    block.min_log = std::log(range.min);
    block.max_log = std::log(range.max);
    block.initial_log = Clamp(std::log(spec.initial.value_or(start)), block);
    block.fixed = spec.fixed;
    blocks_.parameters.push_back(std::move(block));
  };
  for (const ParameterKind kind : kParameterKinds) {
    if (!blocks_.model.Uses(kind)) continue;
    const int first = static_cast<int>(blocks_.parameters.size());
    std::vector<int>& index = blocks_.index[static_cast<std::size_t>(kind)];
    index.resize(blocks_.experiments.size(), first);
    if (blocks_.model[kind].scope == ParameterScope::kShared) {
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

std::vector<double> JointProblem::Start(int number, std::uint64_t seed) const {
  std::vector<double> logs;
  std::mt19937_64 generator(UnitSeed(seed, "start", static_cast<std::uint64_t>(number)));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const ParameterBlock& block : blocks_.parameters) {
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
  for (std::size_t i = 0; i < blocks_.parameters.size(); ++i) {
    problem->AddParameterBlock(logs + i, 1);
    if (blocks_.parameters[i].fixed) {
      problem->SetParameterBlockConstant(logs + i);
      continue;
    }
    problem->SetParameterLowerBound(logs + i, 0, blocks_.parameters[i].min_log);
    problem->SetParameterUpperBound(logs + i, 0, blocks_.parameters[i].max_log);
  }
  for (const ResidualBlock& block : blocks_.residuals) {
    std::vector<double*> pointers;
    for (const int index : block.parameters) pointers.push_back(logs + index);
    problem->AddResidualBlock(block.cost.get(), CreateLoss(block), pointers);
  }
  return problem;
}

std::vector<LoopModel> JointProblem::Models(const std::vector<double>& logs) const {
  CHECK_EQ(logs.size(), blocks_.parameters.size());
  std::vector<LoopModel> models;
  for (int i = 0; i < static_cast<int>(blocks_.experiments.size()); ++i) {
    const auto value = [&](ParameterKind kind) {
      return std::exp(logs[static_cast<std::size_t>(ParameterIndex(kind, i))]);
    };
    LoopModel model{.omega_hz = value(ParameterKind::kOmega),
                    .xi = value(ParameterKind::kXi),
                    .N = value(ParameterKind::kN),
                    .tau_s = value(ParameterKind::kTau),
                    .harmonic_ratio = blocks_.model.harmonic_ratio};
    if (blocks_.model.modes == 2) {
      model.M = blocks_.model.second_mode_relative ? model.N * value(ParameterKind::kMOverN)
                                                   : value(ParameterKind::kM);
    }
    models.push_back(model);
  }
  return models;
}

}  // namespace howl
