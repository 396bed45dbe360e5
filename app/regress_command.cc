#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/problem_input.h"
#include "app/text_table.h"
#include "estimation/family/tradeoff.h"
#include "estimation/joint_fit.h"
#include "io/config/config.h"
#include "io/results/analysis_files.h"
#include "io/results/family_json.h"
#include "io/results/solution_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDefaultTolerance = 1e-6;
// Values this close to zero compare as absolute differences.
constexpr double kZero = 1e-9;

struct Moved {
  std::string name;
  std::string reference;
  std::string fresh;
};

// Text that says how a fit went, not what it found.
bool IsIncidental(const std::string& key) {
  return key == "termination" || key == "iterations" || key == "starts" || key == "text";
}

void Compare(const std::string& name, const Json& reference, const Json& fresh, double tolerance,
             std::vector<Moved>& moved) {
  const auto differs = [&] { moved.push_back({name, reference.dump(), fresh.dump()}); };
  if (reference.is_number() && fresh.is_number()) {
    const double a = reference.get<double>();
    const double b = fresh.get<double>();
    if (!(std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b)) + kZero)) differs();
  } else if (reference.is_object() && fresh.is_object()) {
    for (const auto& [key, value] : reference.items()) {
      if (IsIncidental(key)) continue;
      const std::string inner = name.empty() ? key : name + "." + key;
      Compare(inner, value, fresh.contains(key) ? fresh[key] : Json("missing"), tolerance, moved);
    }
    for (const auto& [key, value] : fresh.items()) {
      if (IsIncidental(key) || reference.contains(key)) continue;
      moved.push_back({name + "." + key, "missing", value.dump()});
    }
  } else if (reference.is_array() && fresh.is_array() && reference.size() == fresh.size()) {
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const Json& item = reference[i];
      const bool named = item.is_object() && item.contains("name");
      const std::string label = named ? item["name"].get<std::string>() : std::to_string(i);
      Compare(name + "[" + label + "]", item, fresh[i], tolerance, moved);
    }
  } else if (reference != fresh) {
    differs();
  }
}

Json FreshSolution(const Config& config, const Options& options,
                   const std::vector<Experiment>& experiments) {
  const JointProblem problem(experiments, config.model, config.residuals);
  const JointFit fit = SolveJoint(problem, config.solver, options.seed, options.threads);
  Json solution = SolutionJson(problem, fit, EstimateVanishingPhi(experiments));
  // What depends on the linear algebra underneath moves with every library; what is listed for each
  // point of a transfer is too long to keep.
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

// What the config's stored results hold: figures, no samples. The analysis where there are records,
// the solution where p and q have a cycle, the trade-off for published tables.
Json FreshResults(const Config& config, const Options& options) {
  const ProblemInput input = LoadInput(config, options);
  Json results = {{"schema", "howl.reference/1"}};
  if (input.analysis) results["analysis"] = AnalysisJson(*input.analysis);
  if (!input.experiments.empty()) {
    results["solution"] = FreshSolution(config, options, input.experiments);
  }
  if (!input.analysis) results["tradeoff"] = FreshTradeoff(config, options, input.experiments);
  return results;
}

Json ReadReference(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) {
    throw UserError(path.string(), 0, "",
                    "no stored results, expected the file that howl regress --update writes");
  }
  try {
    return Json::parse(file);
  } catch (const Json::parse_error& error) {
    throw UserError(path.string(), 0, "", "not JSON, expected stored results");
  }
}

int Run(const Options& options) {
  const Config config = LoadConfig(options.config);
  const std::filesystem::path folder =
      options.Text("--reference")
          .value_or((config.source.parent_path() / ".." / "results" / config.source.stem())
                        .lexically_normal()
                        .string());
  const std::filesystem::path path = folder / "reference.json";
  const double tolerance = options.Number("--tolerance").value_or(kDefaultTolerance);
  const Json fresh = FreshResults(config, options);
  if (options.Has("--update")) {
    WriteWholeFile(path, fresh.dump(1) + "\n");
    if (!options.quiet) std::printf("written: %s\n", path.c_str());
    return kDone;
  }
  const Json reference = ReadReference(path);
  std::vector<Moved> moved;
  Compare("", reference, fresh, tolerance, moved);
  if (moved.empty()) {
    if (!options.quiet) {
      std::printf("%s: as stored, within %s relative\n", config.source.c_str(),
                  Significant(tolerance, 2).c_str());
    }
    return kDone;
  }
  TextTable table({"value", "stored", "now"});
  for (const Moved& value : moved) table.AddRow({value.name, value.reference, value.fresh});
  std::printf("%s%zu values moved by more than %s relative\n", table.Text().c_str(), moved.size(),
              Significant(tolerance, 2).c_str());
  return kNegativeAnswer;
}

}  // namespace

Command RegressCommand() {
  return {"regress",
          "compare a fresh run with the stored reference results",
          "Fits the config anew, computes its trade-off, and compares every value with\n"
          "results/NAME/reference.json beside the config's folder. Names each value that moved;\n"
          "exit status 1 when one did.",
          {{"--tolerance", "T", "relative difference that counts as moved (default: 1e-6)"},
           {"--reference", "DIR", "folder of the stored results"},
           {"--update", "", "store the fresh results as the reference instead"}},
          Run,
          false};
}

}  // namespace howl
