#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line/command.h"
#include "app/diagnose/clipped_heat_release.h"
#include "app/diagnose/diagnose_plan.h"
#include "app/diagnose/diagnose_state.h"
#include "app/diagnose/diagnose_table.h"
#include "app/diagnose/listed_names.h"
#include "app/diagnose/loop_diagnosis_run.h"
#include "app/diagnose/planned_records.h"
#include "app/diagnose/search_options.h"
#include "app/files/digest.h"
#include "app/input/diagnose_input.h"
#include "app/input/record_input.h"
#include "app/jobs/shard.h"
#include "app/jobs/unit_store.h"
#include "app/process/interruption.h"
#include "app/process/progress_line.h"
#include "app/text/diagnose_text.h"
#include "diagnosis/diagnosis.h"
#include "io/config/reading/config_reading.h"
#include "io/results/diagnosis_json.h"
#include "io/whole_file.h"

namespace howl {
namespace {

// The least number of replicates, with which one in twenty can be resolved.
std::size_t Replicates(const Options& options) {
  const std::optional<int> count = options.Count("--bootstrap", 19, 9999);
  if (count && options.Has("--reference")) {
    throw UsageError(
        "--bootstrap simulates the model of the config, and --reference puts records in its "
        "place: expected one or the other");
  }
  return static_cast<std::size_t>(count.value_or(0));
}

// Of --shard, which divides the replicates of the bootstrap.
std::optional<Shard> ShardOfReplicates(const Options& options) {
  const std::optional<Shard> shard = ShardOf(options);
  if (shard && !options.Has("--bootstrap")) {
    throw UsageError("--shard divides the replicates of --bootstrap N, expected that as well");
  }
  return shard;
}

std::filesystem::path DiagnoseStatePath(const Options& options) {
  return options.out / "diagnosis.state";
}

std::vector<DiagnosisExperiment> LoadReference(const Options& options) {
  const auto path = options.Text("--reference");
  return path ? LoadDiagnosisExperiments(LoadConfig(*path)) : std::vector<DiagnosisExperiment>();
}

std::string DiagnoseInputsOf(const Options& options) {
  const Config config = LoadConfig(options.config);
  return Sha256(InputBytes(config, Withheld(options), LoadDiagnosisExperiments(config),
                           LoadReference(options)));
}

void AdoptDiagnoseUnits(const Options& options, const Units& units) {
  WriteWholeFile(DiagnoseStatePath(options),
                 StoreText(DiagnoseStateHeader(DiagnoseInputsOf(options)), units));
}

// What the budget of several causes does not take: another simulator in the model's place,
// replicates, a plan, and declared effects that are not one transfer function at all points.
bool LooksForOneCause(const Config& config, const Options& options) {
  const bool asked =
      std::ranges::any_of(std::array{"--one-cause", "--reference", "--bootstrap", "--plan"},
                          [&](const char* option) { return options.Has(option); });
  return asked || !std::ranges::all_of(DeclaredEffectsOf(config),
                                       [](const auto& each) { return each->IsOneTransfer(); });
}

int Write(const Diagnosis& diagnosis, const Options& options) {
  const std::filesystem::path path = options.out / "diagnosis.json";
  WriteWholeFile(path, DiagnosisJson(diagnosis).dump(2) + "\n");
  if (!options.quiet) {
    PrintDiagnosis(diagnosis);
    std::printf("written: %s\n", path.c_str());
  }
  return kDone;
}

int RunBudget(const Config& config, const Options& options, std::vector<NamedRecord> records) {
  if (const std::optional<Diagnosis> clipped =
          DiagnoseClippedHeatRelease(records, SearchOptions(config, options))) {
    return Write(*clipped, options);
  }
  return RunLoopDiagnosis(config, options, std::move(records));
}

int RunDiagnoseCommand(const Options& options) {
  const Config config = LoadConfig(options.config, LoopsTaken::kAny);
  if (config.record_loop) return RunLoopDiagnosis(config, options, LoadRecords(config));
  const std::optional<Shard> shard = ShardOfReplicates(options);
  std::vector<NamedRecord> records;
  if (HasRecords(config) && !options.Has("--plan")) records = LoadRecords(config);
  if (!records.empty() && !LooksForOneCause(config, options)) {
    return RunBudget(config, options, std::move(records));
  }
  if (options.Has("--with")) {
    throw UsageError(
        "--with begins a budget of records with these items, expected records, and a search for "
        "more than one cause");
  }
  if (options.Has("--plan")) return RunPlan(config, options, Withheld(options));
  if (!HasRecords(config)) return RunTable(config, options);
  const std::vector<DiagnosisExperiment> experiments =
      MakeDiagnosisExperiments(config, std::move(records));
  DiagnosisOptions how = SearchOptions(config, options);
  how.bootstrap = Replicates(options);
  if (!options.quiet && isatty(STDERR_FILENO) != 0) {
    how.bootstrap_progress = [](std::size_t done, std::size_t total) {
      static ProgressLine line("replicates of the bootstrap", false);
      line.Show(done, total);
    };
  }
  if (const auto path = options.Text("--reference")) {
    const Config reference = LoadConfig(*path);
    how.reference = LoadDiagnosisExperiments(reference);
    CheckReference(config, reference, experiments, how.reference);
  }
  WatchForInterruption();
  const std::string inputs = Sha256(InputBytes(config, how.withheld, experiments, how.reference));
  const std::string header =
      shard ? ShardHeader("diagnose", options, inputs, *shard) : DiagnoseStateHeader(inputs);
  if (shard && IsShardDone(options.out, "diagnose", *shard, header)) return kDone;
  const std::filesystem::path state_path =
      shard ? ShardPartPath(options.out, "diagnose", *shard) : DiagnoseStatePath(options);
  UnitStore store(state_path, header);
  if (!options.quiet) SayWhereItGoesOn(store, state_path);
  DiagnoseState state(store);
  how.memory = &state;
  if (shard) how.owns_replicate = [&](std::size_t replicate) { return shard->Owns(replicate); };
  const Diagnosis diagnosis = Diagnose(experiments, how);
  if (IsInterrupted() && diagnosis.stopped) {
    throw Interrupted("interrupted: nothing written; the same command goes on from " +
                      state_path.string());
  }
  if (shard) {
    FinishShard(options, "diagnose", *shard, header, ReadUnits(state_path).units);
    store.Forget();
    return kDone;
  }
  const int status = Write(diagnosis, options);
  store.Forget();
  return status;
}

}  // namespace

Command DiagnoseCommand() {
  return {
      "diagnose",
      "say where and why the model falls short of the rig, and by how much",
      "Fits the loop to all records together and adds, one after the other, the effects and\n"
      "sources of noise without which the records are foretold worse, scored on operating points\n"
      "left out. Needs records with p and q; a table with non-harmonic lines bounds the lag of\n"
      "the q sensor alone.\n"
      "Writes diagnosis.json: the verdict (an effect, several, none, or unknown), those that the\n"
      "data cannot tell from it, the place, the gap before and after, and the budget: what each\n"
      "is worth, and what is left. Effects of your own stand in the config under `effects`. With\n"
      "--plan it writes plan.json instead.",
      {{"--reference", "SIM.yaml",
        "records of another simulator, or of the rig at another time, in the model's place: which "
        "effect turns them into the config's?"},
       {"--bootstrap", "N",
        "simulate N rigs from the refitted base and search each: what noise alone gains, for "
        "p-values and the verdict none (19 or more)"},
       {"--plan", "",
        "diagnose nothing: which effects these records (or records simulated from a table's fit) "
        "can tell apart, from which size on, and which measurement separates the rest"},
       {"--one-cause", "",
        "search the catalogue for the one effect that explains most, by the two cuts of the loop: "
        "as with --reference, --bootstrap, --plan, and where the config declares effects"},
       {"--without", "EFFECTS", "leave these effects, or items of the budget (a,b,...), out"},
       {"--with", "ITEMS",
        "begin the budget with these items (a,b,...), as an earlier diagnosis named them"},
       {"--most-items", "N",
        "end a budget after N items (default: 6; at most 24): more than two make the verdict "
        "unknown in any case, and a rig that lacks many takes minutes for each further one; with 0 "
        "nothing is looked for, and the gap alone is measured"},
       ShardOption()},
      RunDiagnoseCommand,
      true,
      "CONFIG",
      Sharding{DiagnoseInputsOf, AdoptDiagnoseUnits}};
}

}  // namespace howl
