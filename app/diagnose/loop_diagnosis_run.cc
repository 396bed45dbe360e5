#include "app/diagnose/loop_diagnosis_run.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/diagnose/listed_names.h"
#include "app/input/fit_state.h"
#include "app/input/usable_records.h"
#include "app/process/progress_line.h"
#include "app/text/loop_diagnosis_text.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "diagnosis/loop_budget/sample_facts.h"
#include "estimation/joint_records/record_loop_spec.h"
#include "io/results/loop_diagnosis_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

// Options that another base takes alone.
void RefuseOthers(const Options& options) {
  for (const char* option : {"--reference", "--bootstrap", "--plan", "--shard"}) {
    if (!options.Has(option)) continue;
    throw UsageError(std::string(option) +
                     ": the config's model states a loop that is fitted to records, expected the "
                     "paper's loop for it");
  }
}

constexpr char kNoItem[] = "nothing that a loop of records may lack";

std::string Choices(const Options& options) {
  const std::string with = options.Text("--with").value_or("");
  return options.Text("--without").value_or("") + (with.empty() ? "" : " with " + with);
}

// What `--without` may name.
std::vector<std::string> Known() {
  std::vector<std::string> out = LoopItemIds();
  std::ranges::copy(SampleFactIds(), std::back_inserter(out));
  return out;
}

// The config's loop, of which nothing is to be chosen.
LoopForm BaseOf(const Config& config) {
  const RecordLoopSpec& spec = *config.record_loop;
  const auto refuse = [&](const char* key, const char* expected) {
    throw UserError(config.source.string(), config.tree.Find("model")->value.line, key, expected);
  };
  if (spec.choose_modes) {
    refuse("model: modes", "is auto, expected a number: diagnose adds modes to it");
  }
  if (spec.choose_flame_input) {
    refuse("model: flame_input", "is auto, expected one of them: diagnose tries the others");
  }
  return LeastForm(spec);
}

}  // namespace

int RunLoopDiagnosis(const Config& config, const Options& options) {
  RefuseOthers(options);
  LoopBudgetOptions how;
  how.withheld = ListedNames(options, "--without", Known(), kNoItem);
  how.given = ListedNames(options, "--with", LoopItemIds(), kNoItem);
  const LoopForm base = BaseOf(config);
  const std::vector<LoopRecord> records = LoopRecordsOf(LoadUsableRecords(config, options));
  FitState state(config, options, "diagnosis.state", Choices(options));
  if (!options.quiet) state.SayWhereItStands();
  how.starts = StatedStarts(config).value_or(how.starts);
  how.seed = options.seed;
  how.threads = options.threads;
  how.units = &state;
  if (!options.quiet && isatty(STDERR_FILENO) != 0) {
    how.progress = [](std::size_t done, std::size_t total) {
      static ProgressLine line("fits of a step of the budget", false);
      line.Show(done, total);
    };
  }
  const LoopDiagnosis found = DiagnoseLoops(records, base, how);
  const std::filesystem::path path = options.out / "diagnosis.json";
  WriteWholeFile(path, LoopDiagnosisJson(found).dump(2) + "\n");
  state.Forget();
  if (!options.quiet) {
    std::printf("%s", LoopDiagnosisText(found).c_str());
    std::printf("written: %s\n", path.c_str());
  }
  return kDone;
}

}  // namespace howl
