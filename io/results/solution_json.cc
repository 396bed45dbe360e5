#include "io/results/solution_json.h"

#include <cmath>
#include <optional>

#include "estimation/family/membership.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

Json OptionalNumber(const std::optional<double>& value) {
  return value ? NumberOrNull(*value) : Json(nullptr);
}

Json ExperimentJson(const Experiment& experiment, const LoopModel& model) {
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
  }
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

Json IdentifiabilityJson(const JointFit& fit) {
  const Identifiability& what = fit.identifiability;
  Json undetermined = Json::array();
  for (const UndeterminedDirection& direction : what.undetermined) {
    Json components = Json::object();
    for (std::size_t i = 0; i < fit.free_names.size(); ++i) {
      const double component = direction.direction(static_cast<Eigen::Index>(i));
      if (component != 0.0) components[fit.free_names[i]] = component;
    }
    undetermined.push_back({{"text", direction.text},
                            {"log_std", NumberOrNull(direction.log_std)},
                            {"direction", components}});
  }
  Json covariance = Json::array();
  for (Eigen::Index row = 0; row < what.covariance.rows(); ++row) {
    Json values = Json::array();
    for (Eigen::Index k = 0; k < what.covariance.cols(); ++k) {
      values.push_back(NumberOrNull(what.covariance(row, k)));
    }
    covariance.push_back(std::move(values));
  }
  return {{"parameters", fit.free_names.size()},
          {"rank", what.rank},
          {"undetermined", undetermined},
          {"log_covariance", {{"names", fit.free_names}, {"matrix", covariance}}}};
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
                  const VanishingPhi& vanishing_phi) {
  Json experiments = Json::array();
  for (std::size_t i = 0; i < fit.models.size(); ++i) {
    experiments.push_back(ExperimentJson(problem.experiments()[i], fit.models[i]));
  }
  Json shared = Json::object();
  for (std::size_t i = 0; i < problem.parameters().size(); ++i) {
    const ParameterBlock& block = problem.parameters()[i];
    if (block.experiment == kShared) shared[block.name] = fit.parameters[i].value;
  }
  Json residuals = Json::array();
  for (const FitResidual& residual : fit.residuals) {
    residuals.push_back({{"label", residual.label},
                         {"weight", residual.weight},
                         {"standard_deviations", residual.values}});
  }
  return {{"schema", "howl.solution/1"},
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
          {"identifiability", IdentifiabilityJson(fit)},
          {"residuals", residuals}};
}

}  // namespace howl
