#include "io/results/solution_json.h"

#include <cmath>
#include <numeric>
#include <optional>

#include "estimation/family/problem/membership.h"
#include "estimation/fit/loop_crossings.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

Json OptionalNumber(const std::optional<double>& value) {
  return value ? NumberOrNull(*value) : Json(nullptr);
}

Json CrossingsJson(const Experiment& experiment, const LoopModel& model, const ModelSpec& spec) {
  Json crossings = Json::array();
  for (const ObservedCrossing& one : LoopCrossings(experiment, model, spec)) {
    const bool seen = one.observed_hz.has_value();
    crossings.push_back(
        {{"frequency_hz", one.crossing.frequency_hz},
         {"loop_gain", NumberOrNull(one.crossing.gain)},
         {"phase_rate_deg_per_hz", one.crossing.phase_rate_deg_per_hz},
         {"observed_hz", OptionalNumber(one.observed_hz)},
         {"observed_loop_gain", seen ? NumberOrNull(one.observed_gain) : Json(nullptr)},
         {"phase_error_deg", seen ? Json(one.phase_error_deg) : Json(nullptr)}});
  }
  return crossings;
}

Json BranchJson(const ModeBranch& branch, const BranchComparison& comparison) {
  Json models = Json::array();
  for (const LoopModel& model : branch.models) {
    models.push_back({{"omega_hz", model.omega_hz},
                      {"xi", model.xi},
                      {"N", model.N},
                      {"M", model.M},
                      {"tau_s", model.tau_s}});
  }
  return {{"cost", branch.cost},
          {"second_mode_share", branch.share},
          {"second_mode_minor", branch.IsPapers(comparison.share_max)},
          {"models", models}};
}

Json BranchesJson(const BranchComparison& comparison) {
  return {{"share_max", comparison.share_max},
          {"data_prefer_other", comparison.DataPreferOther()},
          {"fit", BranchJson(comparison.fit, comparison)},
          {"other", comparison.other ? BranchJson(*comparison.other, comparison) : Json(nullptr)}};
}

Json ExperimentJson(const Experiment& experiment, const LoopModel& model, const ModelSpec& spec) {
  const ExperimentErrors errors = ComputeErrors(experiment, model);
  Json json = {{"name", experiment.name},
               {"phi", experiment.phi},
               {"reliable", experiment.reliable},
               {"omega_hz", model.omega_hz},
               {"xi", model.xi},
               {"N", model.N},
               {"M", model.M},
               {"tau_s", model.tau_s},
               {"harmonic_ratio", model.harmonic_ratio},
               {"loop_gain", NumberOrNull(errors.loop_gain)},
               {"frequency_hz", experiment.frequency_hz},
               {"phase_deg", experiment.phase_deg},
               {"gain", experiment.gain},
               {"flame_slope", OptionalNumber(experiment.flame_slope)},
               {"gain_error", errors.gain_error},
               {"phase_error_deg", errors.phase_error_deg},
               {"loop_phase_error_deg", errors.loop_phase_error_deg}};
  if (!experiment.lines.empty()) {
    json["second_crossing_error_deg"] = errors.second_crossing_error_deg;
    json["second_crossing_gain"] = NumberOrNull(errors.second_crossing_gain);
  }
  if (spec.modes == 2) json["second_mode_share"] = errors.second_mode_share;
  json["crossings"] = CrossingsJson(experiment, model, spec);
  return json;
}

Json ParametersJson(const JointFit& fit) {
  Json parameters = Json::array();
  for (const FitParameter& parameter : fit.parameters) {
    parameters.push_back({{"name", parameter.name},
                          {"value", parameter.value},
                          {"std_relative", NumberOrNull(parameter.std_relative)},
                          {"at_bound", parameter.at_bound},
                          {"fixed", parameter.fixed}});
  }
  return parameters;
}

// The whole matrix grows as the square of the number of experiments: where it would be longer than
// all else, that of each experiment's parameters with the shared ones takes its place.
constexpr int kLargestMatrix = 512;

Json MatrixJson(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    Json values = Json::array();
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) values.push_back(NumberOrNull(matrix(row, k)));
    rows.push_back(std::move(values));
  }
  return rows;
}

Json CovarianceJson(const JointProblem& problem, const JointFit& fit) {
  const LogCovariance& covariance = fit.identifiability.covariance;
  std::vector<int> columns(static_cast<std::size_t>(covariance.size()));  // none of a failed fit
  std::iota(columns.begin(), columns.end(), 0);
  if (covariance.size() <= kLargestMatrix) {
    return {{"names", fit.free_names}, {"matrix", MatrixJson(covariance.Of(columns))}};
  }
  std::vector<std::vector<int>> own(problem.experiments().size());
  std::vector<int> shared;
  int column = 0;
  for (const ParameterBlock& block : problem.parameters()) {
    if (block.fixed || block.is_q_noise) continue;
    (block.experiment == kShared ? shared : own[static_cast<std::size_t>(block.experiment)])
        .push_back(column++);
  }
  Json blocks = Json::array();
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i].insert(own[i].end(), shared.begin(), shared.end());
    Json names = Json::array();
    for (const int k : own[i]) names.push_back(fit.free_names[static_cast<std::size_t>(k)]);
    blocks.push_back({{"experiment", problem.experiments()[i].name},
                      {"names", std::move(names)},
                      {"matrix", MatrixJson(covariance.Of(own[i]))}});
  }
  return {{"names", fit.free_names}, {"matrix", nullptr}, {"blocks", std::move(blocks)}};
}

Json IdentifiabilityJson(const JointProblem& problem, const JointFit& fit) {
  const Identifiability& what = fit.identifiability;
  Json undetermined = Json::array();
  for (const UndeterminedDirection& direction : what.undetermined) {
    Json components = Json::object();
    for (Eigen::SparseVector<double>::InnerIterator at(direction.direction); at; ++at) {
      if (at.value() != 0.0) {
        components[fit.free_names[static_cast<std::size_t>(at.index())]] = at.value();
      }
    }
    undetermined.push_back({{"text", direction.text},
                            {"log_std", NumberOrNull(direction.log_std)},
                            {"direction", components}});
  }
  return {{"parameters", fit.free_names.size()},
          {"rank", what.rank},
          {"undetermined", undetermined},
          {"log_covariance", CovarianceJson(problem, fit)}};
}

}  // namespace

Json NumberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json VanishingJson(const VanishingPhi& vanishing) {
  if (!vanishing.available) return nullptr;
  return {{"value", NumberOrNull(vanishing.phi)},
          {"lo", NumberOrNull(vanishing.lo)},
          {"hi", NumberOrNull(vanishing.hi)}};
}

Json SolutionJson(const JointProblem& problem, const JointFit& fit,
                  const VanishingPhi& vanishing_phi,
                  const std::optional<BranchComparison>& branches) {
  Json experiments = Json::array();
  for (std::size_t i = 0; i < fit.models.size(); ++i) {
    experiments.push_back(ExperimentJson(problem.experiments()[i], fit.models[i], problem.model()));
  }
  Json shared = Json::object();
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const ParameterBlock& block = problem.parameters()[i];
    if (block.experiment == kShared) shared[block.name] = fit.parameters[i].value;
  }
  Json residuals = Json::array();
  for (const FitResidual& residual : fit.residuals) {
    residuals.push_back({{"label", residual.label},
                         {"weight", residual.weight},
                         {"standard_deviations", residual.values}});
  }
  Json json = {{"schema", "howl.solution/1"},
               {"experiments", experiments},
               {"shared", shared},
               {"vanishing_phi", VanishingJson(vanishing_phi)},
               {"cost", fit.cost},
               {"termination", fit.termination},
               {"converged", fit.converged},
               {"iterations", fit.iterations},
               {"starts",
                {{"tried", fit.starts},
                 {"converged", fit.starts_converged},
                 {"at_best_cost", fit.starts_at_best}}},
               {"parameters", ParametersJson(fit)},
               {"identifiability", IdentifiabilityJson(problem, fit)},
               {"residuals", residuals}};
  if (branches) json["branches"] = BranchesJson(*branches);
  return json;
}

}  // namespace howl
