#include <cstdio>
#include <optional>

#include "app/command_line/command.h"
#include "app/fit/record_fit_run.h"
#include "app/input/config_fit.h"
#include "app/input/problem_input.h"
#include "app/input/record_input.h"
#include "app/text/health_text.h"
#include "app/text/second_mode_text.h"
#include "app/text/text_table.h"
#include "app/text/vanishing_text.h"
#include "estimation/analysis/spectra/half_width.h"
#include "estimation/family/problem/membership.h"
#include "estimation/fit/joint_fit.h"
#include "estimation/health/fit_health.h"
#include "estimation/health/gain_health.h"
#include "estimation/health/mistake_search.h"
#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/results/health_json.h"
#include "io/results/solution_json.h"
#include "io/whole_file.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

constexpr const char* kSoundFit =
    "no parameter at a bound, no residual beyond 3 standard deviations, and no mistake of sign, "
    "order or unit would fit much better undone";

void PrintModels(const JointProblem& problem, const JointFit& fit) {
  const bool two_modes = problem.model().modes == 2;
  std::vector<std::string> header = {"experiment", "f Hz", "omega Hz", "xi", "N"};
  if (two_modes) header.emplace_back("M");
  for (const char* name : {"tau ms", "loop gain", "d gain %", "d phase", "d loop"}) {
    header.emplace_back(name);
  }
  TextTable table(std::move(header));
  for (std::size_t i = 0; i < fit.models.size(); ++i) {
    const Experiment& experiment = problem.experiments()[i];
    const LoopModel& model = fit.models[i];
    const ExperimentErrors errors = ComputeErrors(experiment, model);
    std::vector<std::string> cells = {experiment.name + (experiment.reliable ? "" : " *"),
                                      Fixed(experiment.frequency_hz, 1), Fixed(model.omega_hz, 2),
                                      Fixed(model.xi, 4), Significant(model.N)};
    if (two_modes) cells.push_back(Significant(model.M));
    cells.insert(cells.end(),
                 {Fixed(1e3 * model.tau_s, 4), Fixed(errors.loop_gain, 3),
                  Fixed(kPerCent * errors.gain_error, 2), Fixed(errors.phase_error_deg, 2),
                  Fixed(errors.loop_phase_error_deg, 2)});
    table.AddRow(std::move(cells));
  }
  std::printf("%s", table.Text().c_str());
  std::printf("d: model less data, phases in degrees; * not reliable, weighs less\n");
}

void PrintShared(const JointProblem& problem, const JointFit& fit) {
  bool any_free = false;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    any_free =
        any_free || (problem.parameters()[i].experiment == kShared && !fit.parameters[i].fixed);
  }
  if (any_free) std::printf("shared parameters (%s):\n", kPlusMinusLegend);
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    if (problem.parameters()[i].experiment != kShared) continue;
    const FitParameter& parameter = fit.parameters[i];
    std::printf("%s = %s", parameter.name.c_str(), Significant(parameter.value).c_str());
    if (parameter.fixed) {
      std::printf(" (fixed)\n");
    } else {
      std::printf(" ± %s %%%s\n",
                  Significant(kPerCent * HalfWidth95(parameter.std_relative), 2).c_str(),
                  parameter.at_bound ? " (at its bound)" : "");
    }
  }
}

void PrintIdentifiability(const JointFit& fit) {
  const Identifiability& what = fit.identifiability;
  const std::size_t free_directions = fit.free_names.size() - static_cast<std::size_t>(what.rank);
  std::printf("%zu parameters, %d directions determined, %zu not\n", fit.free_names.size(),
              what.rank, free_directions);
  for (const UndeterminedDirection& direction : what.undetermined) {
    std::printf("%s\n", Wrapped("  " + direction.text, 4).c_str());
  }
}

// Cost per degree of freedom, about 1/2 where the model and the stated standard deviations hold.
double CostPerDegreeOfFreedom(const JointFit& fit) {
  std::size_t residuals = 0;
  for (const FitResidual& residual : fit.residuals) residuals += residual.values.size();
  const auto determined = static_cast<std::size_t>(fit.identifiability.rank);
  return residuals > determined ? fit.cost / static_cast<double>(residuals - determined) : 0.0;
}

Health CheckAll(const Config& config, const Options& options, const ProblemInput& input,
                const JointProblem& problem, const JointFit& fit) {
  Health health;
  if (input.analysis) {
    health =
        CheckRecords(config, input.records, *input.analysis, MakeAnalysisOptions(config, options));
  } else {
    health = CheckGains(problem.experiments());
  }
  Append(CheckFit(problem, fit), health);
  std::vector<std::string> recorded;
  for (const ExperimentConfig& each : config.experiments) {
    if (each.record) recorded.push_back(each.experiment.name);
  }
  Append(FindMistakes(problem, config.residuals, fit,
                      {.recorded = recorded,
                       .solver = config.solver,
                       .seed = options.seed,
                       .threads = options.threads}),
         health);
  return health;
}

int RunFitCommand(const Options& options) {
  const Config config = LoadConfig(options.config, LoopsTaken::kAny);
  if (config.record_loop) return RunRecordFit(config, options);
  const ProblemInput input = LoadInput(config, options);
  RequireExperiments(config, options, input);
  const JointProblem problem = MakeJointProblem(config, input.experiments);
  const JointFit fit = SolveConfig(config, options, problem);
  const VanishingPhi vanishing_phi = EstimateVanishingPhi(problem.experiments());
  std::optional<BranchComparison> branches;
  if (config.model.modes == 2) {
    branches = CompareBranches(problem, config.residuals, fit, config.solver, options.seed,
                               options.threads);
  }
  const std::filesystem::path path = options.out / "solution.json";
  const Health health = CheckAll(config, options, input, problem, fit);
  nlohmann::ordered_json solution = SolutionJson(problem, fit, vanishing_phi, branches);
  solution["health"] = HealthJson(health);
  WriteWholeFile(path, solution.dump(2) + "\n");
  if (!options.quiet) {
    PrintModels(problem, fit);
    std::printf("%s", CrossingsText(problem, fit).c_str());
    PrintShared(problem, fit);
    std::printf("cost %s, %s a degree of freedom; %d of %d starts reached it; %s\n",
                Significant(fit.cost).c_str(), Significant(CostPerDegreeOfFreedom(fit), 3).c_str(),
                fit.starts_at_best, fit.starts,
                fit.converged ? "converged" : fit.termination.c_str());
    if (branches) std::printf("%s", BranchText(*branches).c_str());
    std::printf("%s", VanishingText(vanishing_phi, config.operating_parameter).c_str());
    PrintIdentifiability(fit);
    std::printf("written: %s\n", path.c_str());
    std::printf("%s", HealthText(health, kSoundFit, "solution.json").c_str());
  }
  return fit.converged ? kDone : kNegativeAnswer;
}

}  // namespace

Command FitCommand() {
  return {
      "fit",
      "fit acoustics and delay to all experiments together",
      "Minimises all residuals of the config over all experiments in one problem, from several\n"
      "starts, and reports which directions in parameter space the data leave undetermined.\n"
      "Ends with what speaks against the fit: parameters at bounds, residuals beyond 3 standard\n"
      "deviations, and mistakes in the data that would fit much better undone. Writes\n"
      "solution.json. Exit status 1 when no start converged, or a parameter stands where the\n"
      "search ends.",
      {},
      RunFitCommand};
}

}  // namespace howl
