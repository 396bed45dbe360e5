#include <cstdio>
#include <limits>

#include "app/command.h"
#include "app/problem_input.h"
#include "app/text_table.h"
#include "estimation/family/conflict.h"
#include "estimation/family/enclose.h"
#include "estimation/family/enumerate.h"
#include "estimation/family/tradeoff.h"
#include "io/config/config.h"
#include "io/results/family_csv.h"
#include "io/results/family_json.h"
#include "io/results/whole_file.h"

namespace howl {
namespace {

void PrintConflict(const Conflict& conflict) {
  std::printf("the family is empty%s\n",
              conflict.proved ? "" : " as far as the search went; this is not a proof");
  for (const std::vector<Condition>& set : conflict.minimal_sets) {
    std::string names;
    for (const Condition condition : set) {
      names += (names.empty() ? "" : ", ") + std::string(ConditionName(condition));
    }
    std::printf("  exclude each other: %s\n", names.c_str());
  }
  for (const Relaxation& relaxation : conflict.relaxations) {
    if (!relaxation.suffices) continue;
    std::printf("  %s is %s; %s\n", std::string(ConditionName(relaxation.condition)).c_str(),
                Significant(relaxation.value).c_str(),
                relaxation.needed
                    ? ("with " + Significant(*relaxation.needed) + " there is a member").c_str()
                    : "without it there is a member");
  }
}

// "212.81 .. 219.75" from the members found; what the guaranteed bound adds follows in brackets
// where it shows.
std::string RangeText(const Range& range, double factor, int digits) {
  return Significant(factor * range.lo, digits) + " .. " + Significant(factor * range.hi, digits);
}

void PrintBounds(const FamilyProblem& problem, const Enclosure& enclosure) {
  std::vector<std::string> header = {"experiment", "omega Hz", "xi", "N"};
  std::vector<FamilyParameter> shown = {FamilyParameter::kOmega, FamilyParameter::kXi,
                                        FamilyParameter::kN};
  if (problem.model.modes == 2) {
    header.emplace_back("M");
    shown.push_back(FamilyParameter::kM);
  }
  header.emplace_back("tau ms");
  shown.push_back(FamilyParameter::kTau);
  header.emplace_back("loop gain");
  shown.push_back(FamilyParameter::kLoopGain);
  TextTable table(std::move(header));
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    std::vector<std::string> cells = {problem.experiments[i].name};
    for (const FamilyParameter parameter : shown) {
      if (!enclosure.IsBounded(i, parameter)) {
        cells.emplace_back("-");
        continue;
      }
      const double factor = parameter == FamilyParameter::kTau ? 1e3 : 1.0;
      cells.push_back(RangeText(enclosure.Bound(i, parameter).outer, factor, 4));
    }
    table.AddRow(std::move(cells));
  }
  std::printf("no member lies outside (guaranteed):\n%s", table.Text().c_str());
}

// The parameter whose guaranteed bound exceeds the members found by most, relative to their range.
void PrintTightness(const FamilyProblem& problem, const Enclosure& enclosure) {
  double widest = -1.0;
  double tightest = std::numeric_limits<double>::infinity();
  std::string widest_name;
  std::string tightest_name;
  std::size_t open = 0;
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    for (const FamilyParameter parameter : kFamilyParameters) {
      if (!enclosure.IsBounded(i, parameter)) continue;
      const EnclosedBound bound = enclosure.Bound(i, parameter);
      const std::string name =
          problem.experiments[i].name + "." + std::string(FamilyParameterName(parameter));
      if (!bound.closed) ++open;
      if (bound.Excess() > widest) {
        widest = bound.Excess();
        widest_name = name;
      }
      if (bound.Excess() < tightest) {
        tightest = bound.Excess();
        tightest_name = name;
      }
    }
  }
  std::printf("members reach the bounds to within %s %% (%s) .. %s %% (%s) of their range\n",
              Significant(100.0 * tightest, 2).c_str(), tightest_name.c_str(),
              Significant(100.0 * widest, 2).c_str(), widest_name.c_str());
  if (open > 0) std::printf("%zu bounds are not as tight as asked: the budget ran out\n", open);
}

int Run(const Options& options) {
  const Config config = LoadConfig(options.config);
  const FamilyProblem problem = MakeFamilyProblem(config, LoadExperiments(config, options));
  const Enumeration enumeration = EnumerateMembers(
      problem, static_cast<std::size_t>(config.family.members), options.seed, options.threads);
  Enclosure enclosure(
      problem, {.width = config.family.width, .seed = options.seed, .threads = options.threads});
  enclosure.Run();
  Conflict conflict;
  if (enumeration.members.empty()) conflict = ExplainEmpty(problem, options.threads);
  const std::vector<TradeoffPoint> tradeoff =
      ComputeTradeoff(problem, DefaultSpreads(problem), options.threads, options.seed);

  WriteWholeFile(options.out / "family.csv", FamilyCsv(problem.experiments, enumeration.members));
  WriteWholeFile(options.out / "tradeoff.csv", TradeoffCsv(tradeoff));
  WriteWholeFile(options.out / "family.json",
                 FamilyJson(problem, enumeration, enclosure, conflict).dump(2) + "\n");
  if (!options.quiet) {
    if (enumeration.members.empty()) {
      PrintConflict(conflict);
    } else {
      std::printf("%zu members listed that the data cannot reject\n", enumeration.members.size());
      PrintBounds(problem, enclosure);
      PrintTightness(problem, enclosure);
    }
    std::printf("written: family.csv, family.json and tradeoff.csv in %s\n", options.out.c_str());
  }
  return enumeration.members.empty() ? kNegativeAnswer : kDone;
}

}  // namespace

Command FamilyCommand() {
  return {"family",
          "list and bound all models that the data cannot reject",
          "Lists members of the family: models that pass every condition of the config's\n"
          "`family: test:`. Writes family.csv, family.json and tradeoff.csv. When the family is\n"
          "empty, names the conditions that exclude each other and exits with 1.",
          {},
          Run};
}

}  // namespace howl
