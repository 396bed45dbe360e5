#include "app/diagnose/loop_diagnosis_run.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/command_line/command.h"
#include "app/diagnose/listed_names.h"
#include "app/diagnose/next_config.h"
#include "app/input/diagnose_input.h"
#include "app/input/fit_state.h"
#include "app/input/usable_records.h"
#include "app/process/progress_line.h"
#include "app/text/loop_diagnosis_text.h"
#include "app/text/text_table.h"
#include "diagnosis/loop_budget/loop_budget.h"
#include "estimation/joint_records/record_loop_spec.h"
#include "io/results/loop_diagnosis_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

// Options of the search for one cause, which takes the paper's loop alone.
void RefuseOthers(const Options& options) {
  for (const char* option : {"--one-cause", "--reference", "--bootstrap", "--plan", "--shard"}) {
    if (!options.Has(option)) continue;
    throw UsageError(std::string(option) +
                     ": the config's model states a loop that is fitted to records, expected the "
                     "paper's loop for it");
  }
}

// Unless asked for more: a rig that lacks many items takes minutes for each further one, and more
// than two make the verdict unknown in any case.
constexpr int kFirstItems = 6;

constexpr char kNoItem[] = "nothing that a loop of records may lack";

std::string Choices(const Options& options) {
  const std::string with = options.Text("--with").value_or("");
  const std::string most = options.Text("--most-items").value_or("");
  return options.Text("--without").value_or("") + (with.empty() ? "" : " with " + with) +
         (most.empty() ? "" : " most " + most);
}

// The config's loop, of which nothing is to be chosen.
LoopForm LoopBaseOf(const Config& config) {
  if (!config.record_loop) {
    return PapersForm(ModesOfLoop(config), config.model.harmonic_ratio);
  }
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

// A rate in kHz that was meant in Hz would else be fitted as it stands.
constexpr double kLeastSampling_hz = 100.0;

void RequireHertz(const Config& config, const std::vector<LoopRecord>& records) {
  for (const LoopRecord& each : records) {
    if (each.record.sampling_hz >= kLeastSampling_hz) continue;
    throw UserError(config.source.string(), ExperimentNamed(config, each.name).line, "experiments",
                    each.name + " is sampled at " + Significant(each.record.sampling_hz, 3) +
                        " Hz, expected at least " + Significant(kLeastSampling_hz, 3) + " Hz");
  }
}

std::vector<EffectPointer> DeclaredIn(const Config& config) {
  std::vector<EffectPointer> out;
  for (const auto& effect : DeclaredEffectsOf(config)) {
    if (!effect->IsOneTransfer()) {
      throw UserError(config.source.string(), config.tree.Find("effects")->value.line, "effects",
                      std::string(effect->id()) +
                          " is not one transfer function at all operating points, expected one of "
                          "an instrument or of the flame: the config's model states a loop");
    }
    out.push_back(effect);
  }
  return out;
}

}  // namespace

int RunLoopDiagnosis(const Config& config, const Options& options, std::vector<NamedRecord> read) {
  if (config.record_loop) RefuseOthers(options);
  LoopBudgetOptions how;
  how.withheld = Withheld(options);
  how.given = ListedNames(options, "--with", LoopItemIds(), kNoItem);
  how.declared = DeclaredIn(config);
  how.most_items = static_cast<std::size_t>(
      options.Count("--most-items", 0, static_cast<int>(kMostItems)).value_or(kFirstItems));
  how.one_delay = !config.record_loop && !(StatesDelays(config) && BaseOf(config).own_delays);
  const LoopForm base = LoopBaseOf(config);
  const std::vector<LoopRecord> records =
      LoopRecordsOf(UsableRecords(config, options, std::move(read)));
  if (!config.record_loop) RequireHertz(config, records);
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
  std::vector<std::string> names;
  for (const LoopRecord& each : records) names.push_back(each.name);
  const std::filesystem::path next_path = NextConfigPath(config, options.out);
  const std::optional<std::string> next = NextConfig(config, names, found);
  if (next) {
    WriteWholeFile(next_path, *next);
  } else {
    std::error_code ignored;
    std::filesystem::remove(next_path, ignored);  // an earlier diagnosis may have found more
  }
  state.Forget();
  if (!options.quiet) {
    std::printf("%s", LoopDiagnosisText(found).c_str());
    if (next) {
      std::printf("written: diagnosis.json and %s (a config of what was found) in %s\n",
                  next_path.filename().c_str(), options.out.c_str());
    } else {
      std::printf("written: %s\n", path.c_str());
    }
  }
  return kDone;
}

}  // namespace howl
