#include "app/input/problem_input.h"

#include <cstdio>
#include <utility>

#include "app/input/record_input.h"
#include "app/text/delay_text.h"
#include "io/user_error.h"

namespace howl {
namespace {

// The reason why a record gives no experiment to fit and family.
std::string Shortcoming(const Analysis& analysis, const AnalysisOptions& options) {
  if (!analysis.has_heat_release) return analysis.name + " has no heat release: left out";
  std::string text = analysis.name + " shows no limit cycle: left out";
  for (const Finding& finding : CheckState(analysis, options.characteristics)) {
    text += " (" + finding.text + ")";
  }
  return text;
}

// The family's searches move omega, N and tau with xi, so that of one experiment's parameters they
// can hold xi alone at a value.
void CheckOwnParameters(const Config& config) {
  for (const OwnParameter& own : config.model.own) {
    if (!own.spec.fixed || own.kind == ParameterKind::kXi) continue;
    const std::string key = own.experiment + "." + std::string(ParameterName(own.kind));
    const LocatedMember* const parameters = config.tree.Find("parameters");
    const LocatedMember* const member = parameters ? parameters->value.Find(key) : nullptr;
    throw UserError(
        config.source.string(), member ? member->key_line : 0, "parameters." + key,
        "is fixed for one experiment, which the family takes for xi alone; expected min "
        "and max, or the parameter fixed for all experiments");
  }
}

}  // namespace

ProblemInput LoadInput(const Config& config, const Options& options) {
  return AnalyseInput(config, options, LoadRecords(config));
}

ProblemInput AnalyseInput(const Config& config, const Options& options,
                          std::vector<NamedRecord> records) {
  ProblemInput input;
  input.records = std::move(records);
  const AnalysisOptions analysis_options = MakeAnalysisOptions(config, options);
  if (!input.records.empty()) {
    input.analysis = AnalyseRecords(input.records, analysis_options);
  }
  std::size_t next = 0;
  for (const ExperimentConfig& each : config.experiments) {
    if (!each.record) {
      input.experiments.push_back(each.experiment);
      continue;
    }
    const Analysis& analysis = input.analysis->analyses[next++];
    std::optional<Experiment> experiment = ToExperiment(analysis);
    if (!experiment) {
      input.notes.push_back(Shortcoming(analysis, analysis_options));
      continue;
    }
    experiment->delay_periods = input.analysis->delay.branch;
    experiment->reliable = experiment->reliable && each.experiment.reliable;
    input.experiments.push_back(*std::move(experiment));
  }
  if (input.analysis && DelayIsOpen(input.analysis->delay)) {
    std::string note = DelayText(input.analysis->delay);
    note.pop_back();  // the end of the line
    input.notes.push_back(std::move(note));
  }
  return input;
}

void PrintNotes(const Options& options, const ProblemInput& input) {
  if (options.quiet) return;
  for (const std::string& line : input.notes) std::fprintf(stderr, "%s\n", line.c_str());
}

void RequireExperiments(const Config& config, const Options& options, const ProblemInput& input) {
  if (!input.experiments.empty()) return PrintNotes(options, input);
  std::string why;
  for (std::size_t i = 0; i < input.records.size() && why.empty(); ++i) {
    for (const Finding& finding :
         CheckSampling(input.records[i], input.analysis->analyses[i],
                       MakeAnalysisOptions(config, options), RateSources(config)[i])) {
      why = "; " + finding.text;
    }
  }
  throw UserError(config.source.string(), config.experiments.front().line, "experiments",
                  "no record shows a limit cycle in p and q, expected at least one" + why);
}

std::vector<Experiment> LoadExperiments(const Config& config, const Options& options) {
  ProblemInput input = LoadInput(config, options);
  RequireExperiments(config, options, input);
  return std::move(input.experiments);
}

FamilyProblem MakeFamilyProblem(const Config& config, std::vector<Experiment> experiments) {
  FamilyProblem problem;
  problem.experiments = std::move(experiments);
  problem.model = config.model;
  problem.test = config.family.test;
  problem.domain.delay_periods = problem.experiments.front().delay_periods;
  CheckOwnParameters(config);
  const ModelSpec defaults = DefaultModelSpec();
  for (const ParameterKind kind : kParameterKinds) {
    const ParameterSpec& spec = config.model[kind];
    // A parameter that is held at one value is the same for all experiments.
    if (spec.fixed) problem.model[kind].scope = ParameterScope::kShared;
    if (spec.min != defaults[kind].min) problem.domain[kind].lo = spec.min;
    if (spec.max != defaults[kind].max) problem.domain[kind].hi = spec.max;
  }
  return problem;
}

}  // namespace howl
