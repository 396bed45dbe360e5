#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/family/family_run.h"
#include "app/input/config_fit.h"
#include "app/input/problem_input.h"
#include "app/text/text_table.h"
#include "estimation/family/answers/tradeoff.h"
#include "estimation/fit/joint_fit.h"
#include "io/config/config.h"
#include "io/config/reading/config_reading.h"
#include "io/config/sections/absent_record.h"
#include "io/results/analysis_files.h"
#include "io/results/family/family_json.h"
#include "io/results/family/member_summary.h"
#include "io/results/reference_file.h"
#include "io/results/solution_json.h"
#include "io/whole_file.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDefaultTolerance = 1e-6;

Json FreshSolution(const Config& config, const Options& options,
                   const std::vector<Experiment>& experiments) {
  const JointProblem problem = MakeJointProblem(config, experiments);
  const JointFit fit = SolveConfig(config, options, problem);
  Json solution = SolutionJson(problem, fit, EstimateVanishingPhi(experiments));
  // Left out are values that depend on the linear algebra library, and lists for each point of a
  // transfer, which are too long to keep.
  solution.erase("identifiability");
  if (config.experiments.front().record) solution.erase("residuals");
  return solution;
}

Json FreshTradeoff(const Config& config, const Options& options,
                   const std::vector<Experiment>& experiments) {
  const FamilyProblem family = MakeFamilyProblem(config, experiments);
  Json tradeoff = Json::array();
  for (const TradeoffPoint& point :
       ComputeTradeoff(family, DefaultSpreads(family, 11), options.threads, options.seed)) {
    tradeoff.push_back({{"omega_spread", point.omega_spread},
                        {"xi_max", point.xi_max ? Json(*point.xi_max) : Json(nullptr)}});
  }
  return tradeoff;
}

// The family's bounds, members and predictions, without numbers that tell how the searches went.
Json FreshFamily(const Config& config, const Options& options,
                 const std::vector<Experiment>& experiments) {
  const FamilyRun run = RunFamilyAnew(config, options, experiments);
  Json family = FamilyFiguresJson(ReportOf(config, run));
  family["members"] = MemberSummaryJson(run.problem, run.members);
  return family;
}

// What the config's stored results hold: figures, no samples. The analysis where there are records,
// solution and family where p and q have a cycle, the trade-off for published tables.
Json FreshResults(const Config& config, const Options& options, bool with_family) {
  const ProblemInput input = LoadInput(config, options);
  PrintNotes(options, input);
  Json results = {{"schema", kReferenceSchema}};
  if (input.analysis) results["analysis"] = AnalysisJson(*input.analysis);
  if (!input.experiments.empty()) {
    results["solution"] = FreshSolution(config, options, input.experiments);
  }
  if (!input.analysis) results["tradeoff"] = FreshTradeoff(config, options, input.experiments);
  if (with_family && !input.experiments.empty()) {
    results["family"] = FreshFamily(config, options, input.experiments);
  }
  return results;
}

std::filesystem::path ReferencePath(const Options& options) {
  const std::filesystem::path folder = options.config.parent_path() / ".." / "results";
  const std::string default_folder = (folder / options.config.stem()).lexically_normal().string();
  return std::filesystem::path(options.Text("--reference").value_or(default_folder)) /
         "reference.json";
}

// No value on a machine without the config's records, where there is nothing to compare.
std::optional<Config> LoadUnlessAbsent(const Options& options) {
  try {
    return LoadConfig(options.config);
  } catch (const AbsentRecord& absent) {
    if (options.Has("--update")) throw;
    if (!options.quiet) std::printf("skipped: %s\n", absent.what());
    return std::nullopt;
  }
}

int RunRegressCommand(const Options& options) {
  const std::filesystem::path path = ReferencePath(options);
  const double tolerance = options.Number("--tolerance").value_or(kDefaultTolerance);
  const bool updates = options.Has("--update");
  const std::optional<Config> read = LoadUnlessAbsent(options);
  if (!read) return kDone;
  const Config& config = *read;
  // Damage is reported before the work, not after it.
  Json reference;
  if (!updates) reference = ReadReference(path);
  const bool is_earlier = !updates && reference["schema"] == kReferenceSchemaBefore;
  Json fresh = FreshResults(config, options, !is_earlier);
  if (updates) {
    WriteWholeFile(path, fresh.dump(1) + "\n");
    if (!options.quiet) std::printf("written: %s\n", path.c_str());
    return kDone;
  }
  if (is_earlier) {
    fresh["schema"] = kReferenceSchemaBefore;
    if (!options.quiet) {
      std::printf("%s holds no family (schema %s): howl regress --update stores it\n", path.c_str(),
                  kReferenceSchemaBefore);
    }
  }
  const std::vector<MovedFigure> moved = CompareReference(path, reference, fresh, tolerance);
  if (moved.empty()) {
    if (!options.quiet) {
      std::printf("%s: as stored, within %s relative\n", config.source.c_str(),
                  Significant(tolerance, 2).c_str());
    }
    return kDone;
  }
  for (const MovedFigure& each : moved) {
    std::printf("%s: %s stored, %s now\n", each.name.c_str(), each.stored.c_str(),
                each.fresh.c_str());
  }
  std::printf("%zu value%s moved by more than %s relative\n", moved.size(),
              moved.size() == 1 ? "" : "s", Significant(tolerance, 2).c_str());
  return kNegativeAnswer;
}

}  // namespace

Command RegressCommand() {
  return {"regress",
          "compare a fresh run with the stored reference results",
          "Fits the config anew, computes its trade-off and its family (the test, bounds, counts,\n"
          "predictions, members) and compares every value with results/NAME/reference.json beside\n"
          "the config's folder. Names each value that moved, as stored and as it is now; exit\n"
          "status 1 when one did. A config whose records are not on this machine is skipped.",
          {{"--tolerance", "T", "relative difference that counts as moved (default: 1e-6)"},
           {"--reference", "DIR", "folder of the stored results"},
           {"--update", "", "store the fresh results as the reference instead"}},
          RunRegressCommand,
          false};
}

}  // namespace howl
