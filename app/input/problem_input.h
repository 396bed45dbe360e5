// From a config to the experiments that fit and family take, and to the family's problem.
#ifndef HOWL_APP_INPUT_PROBLEM_INPUT_H_
#define HOWL_APP_INPUT_PROBLEM_INPUT_H_

#include <optional>
#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "estimation/analysis/analyse.h"
#include "estimation/analysis/loop/experiment.h"
#include "estimation/family/problem/problem.h"
#include "io/config/config.h"

namespace howl {

struct ProblemInput {
  std::vector<Experiment> experiments;  // that fit and family can take; may be empty
  std::optional<AnalysisSet> analysis;  // when the config has records
  std::vector<NamedRecord> records;     // that were analysed
  // What the user should know before the answer: a line for each record that gives no experiment,
  // and one for a delay whose whole periods the records cannot tell.
  std::vector<std::string> notes;
};

// Published numbers as they are; records analysed first. An experiment whose record shows no limit
// cycle or has no heat release is left out.
ProblemInput LoadInput(const Config& config, const Options& options);

// The same of records that were read already: those of `config`, in its order.
ProblemInput AnalyseInput(const Config& config, const Options& options,
                          std::vector<NamedRecord> records);

// On standard error, unless the user wants it quiet.
void PrintNotes(const Options& options, const ProblemInput& input);

// Throws UserError when no experiment is left, with what the analysis says of the first; else
// prints the notes.
void RequireExperiments(const Config& config, const Options& options, const ProblemInput& input);

// The experiments alone. Throws UserError when none is left.
std::vector<Experiment> LoadExperiments(const Config& config, const Options& options);

// The family's problem. Only bounds that the config gives limit it: the guard rails of a fit do not
// belong to the falsification test.
FamilyProblem MakeFamilyProblem(const Config& config, std::vector<Experiment> experiments);

}  // namespace howl

#endif  // HOWL_APP_INPUT_PROBLEM_INPUT_H_
