#include <cstdio>

#include "app/command_line/command.h"
#include "app/family/bounds_run.h"
#include "app/family/family_run.h"
#include "app/family/family_text.h"
#include "app/input/without_conditions.h"
#include "io/config/reading/config_reading.h"
#include "io/result_files.h"
#include "io/results/family/family_csv.h"
#include "io/results/family/family_json.h"
#include "io/whole_file.h"

namespace howl {
namespace {

int RunFamilyCommand(const Options& options) {
  const Config config = WithoutConditions(LoadConfig(options.config), options);
  if (const std::optional<Shard> shard = ShardOf(options)) {
    RunFamilyShard(config, options, *shard);
    return kDone;
  }
  const FamilyRun run = RunFamily(config, options);
  WriteWholeFile(options.out / kFamilyCsv,
                 FamilyCsv(run.problem.experiments, run.members, config.operating_parameter));
  WriteWholeFile(options.out / kTradeoffCsv, TradeoffCsv(run.tradeoff));
  WriteWholeFile(options.out / "family.json", FamilyJson(ReportOf(config, run)).dump(2) + "\n");
  if (run.profile) {
    WriteWholeFile(options.out / kProfileCsv,
                   ProfileCsv(run.problem.experiments, run.profile->profile));
  }
  ForgetBounds(options);
  if (!options.quiet) {
    PrintFamily(run);
    std::printf("written: family.csv, %sfamily.json and tradeoff.csv in %s\n",
                run.profile ? "profile.csv, " : "", options.out.c_str());
  }
  return run.members.empty() ? kNegativeAnswer : kDone;
}

std::string FamilyInputsOf(const Options& options) {
  return FamilyInputsSha256(LoadConfig(options.config), options);
}

}  // namespace

Command FamilyCommand() {
  return {
      "family",
      "list and bound all models that the data cannot reject",
      "A model belongs to the family when it passes every condition of the config's\n"
      "`family: test:`. Bounds each parameter with a guarantee, lists members spread over\n"
      "the whole set (50 or fewer: chosen far apart), and computes the trade-off between the\n"
      "spread of omega and the largest xi. Writes family.csv, family.json and tradeoff.csv. When "
      "the family is\n"
      "empty, names the conditions that exclude each other and exits with 1. Interrupted work\n"
      "goes on where it stopped.",
      {WithoutOption(),
       {"--falsify", "OTHER.yaml", "which members survive the experiments of another config"},
       {"--advise", "", "which further measurement would remove most of the family"},
       {"--profile", "QUANTITY",
        "the best fit along exp1.tau_s, exp1.loop_gain, a prediction or any expression"},
       {"--save-every", "SECONDS", "how often the search for bounds saves its state (default: 2)"},
       ShardOption()},
      RunFamilyCommand,
      true,
      "CONFIG",
      Sharding{FamilyInputsOf, AdoptBounds}};
}

}  // namespace howl
