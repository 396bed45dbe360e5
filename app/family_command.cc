#include <cstdio>

#include "app/command.h"
#include "app/problem_input.h"
#include "app/text_table.h"
#include "estimation/family/conflict.h"
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

void PrintSpread(const FamilyProblem& problem, const std::vector<Member>& members) {
  TextTable table({"experiment", "omega Hz", "xi", "N", "M", "tau ms", "loop gain"});
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    Range omega, xi, N, M, tau, gain;
    for (Range* range : {&omega, &xi, &N, &M, &tau, &gain}) *range = {1e300, -1e300};
    const auto extend = [](Range& range, double value) {
      range.lo = std::min(range.lo, value);
      range.hi = std::max(range.hi, value);
    };
    for (const Member& member : members) {
      extend(omega, member[i].omega_hz);
      extend(xi, member[i].xi);
      extend(N, member[i].N);
      extend(M, member[i].M);
      extend(tau, 1e3 * member[i].tau_s);
      extend(gain, ComputeErrors(problem.experiments[i], member[i]).loop_gain);
    }
    const auto text = [](const Range& range, int digits) {
      return Significant(range.lo, digits) + " .. " + Significant(range.hi, digits);
    };
    table.AddRow({problem.experiments[i].name, text(omega, 5), text(xi, 3), text(N, 4), text(M, 4),
                  text(tau, 5), text(gain, 4)});
  }
  std::printf("%s", table.Text().c_str());
}

int Run(const Options& options) {
  const Config config = LoadConfig(options.config);
  const FamilyProblem problem = MakeFamilyProblem(config, LoadExperiments(config, options));
  const Enumeration enumeration = EnumerateMembers(
      problem, static_cast<std::size_t>(config.family.members), options.seed, options.threads);
  Conflict conflict;
  if (enumeration.members.empty()) conflict = ExplainEmpty(problem, options.threads);
  const std::vector<TradeoffPoint> tradeoff =
      ComputeTradeoff(problem, DefaultSpreads(problem), options.threads, options.seed);

  WriteWholeFile(options.out / "family.csv", FamilyCsv(problem.experiments, enumeration.members));
  WriteWholeFile(options.out / "tradeoff.csv", TradeoffCsv(tradeoff));
  WriteWholeFile(options.out / "family.json",
                 FamilyJson(problem, enumeration, conflict).dump(2) + "\n");
  if (!options.quiet) {
    if (enumeration.members.empty()) {
      PrintConflict(conflict);
    } else {
      std::printf("%zu members of the family that the data cannot reject:\n",
                  enumeration.members.size());
      PrintSpread(problem, enumeration.members);
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
