#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include "app/command.h"
#include "app/diagnose_state.h"
#include "app/diagnose_table.h"
#include "app/diagnose_text.h"
#include "app/interruption.h"
#include "app/progress_line.h"
#include "app/record_input.h"
#include "diagnosis/diagnosis.h"
#include "io/config/nearest_key.h"
#include "io/results/diagnosis_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

constexpr std::size_t kFewestSamples = 4096;

std::vector<DiagnosisExperiment> LoadDiagnosisExperiments(const Config& config) {
  const std::string file = config.source.string();
  std::vector<DiagnosisExperiment> experiments;
  for (NamedRecord& named : LoadRecords(config)) {
    if (named.record.heat_release.empty()) {
      throw UserError(file, config.experiments.front().line, "heat_release",
                      named.name +
                          " has pressure alone, expected both signals: the diagnosis cuts "
                          "the loop between them");
    }
    if (named.record.pressure.size() < kFewestSamples) {
      throw UserError(file, config.experiments.front().line, "record",
                      named.name + " has " + std::to_string(named.record.pressure.size()) +
                          " samples, expected at least " + std::to_string(kFewestSamples));
    }
    experiments.push_back({named.name, named.phi, std::move(named.record)});
  }
  if (experiments.empty()) {
    throw UserError(file, config.experiments.front().line, "experiments",
                    "no experiment has a record, expected at least one to diagnose");
  }
  return experiments;
}

// Operating points are found by name or parameter, and interpolated in between.
void CheckReference(const Config& config, const Config& reference,
                    const std::vector<DiagnosisExperiment>& rig,
                    const std::vector<DiagnosisExperiment>& model) {
  const std::string file = reference.source.string();
  const int line = reference.experiments.front().line;
  if (config.operating_parameter != reference.operating_parameter) {
    throw UserError(file, line, "operating_parameter",
                    "is " + reference.operating_parameter + " here, expected " +
                        config.operating_parameter + " as in " + config.source.string());
  }
  const auto [low, high] = std::minmax_element(
      model.begin(), model.end(),
      [](const DiagnosisExperiment& a, const DiagnosisExperiment& b) { return a.phi < b.phi; });
  for (const DiagnosisExperiment& each : rig) {
    const bool named =
        std::any_of(model.begin(), model.end(),
                    [&](const DiagnosisExperiment& other) { return other.name == each.name; });
    if (named || (each.phi >= low->phi && each.phi <= high->phi)) continue;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", each.phi);
    throw UserError(file, line, "experiments",
                    "have none called " + each.name + ", and none on both sides of its " +
                        config.operating_parameter + " " + text.data() +
                        ", expected one or the other");
  }
}

// What a state file belongs to: the config's text (it has the effects) and every number.
std::string Inputs(const Config& config, const std::vector<DiagnosisExperiment>& rig,
                   const std::vector<DiagnosisExperiment>& reference) {
  std::ifstream file(config.source, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  for (const std::vector<DiagnosisExperiment>* each : {&rig, &reference}) {
    text << each->size() << "\n";
    for (const DiagnosisExperiment& experiment : *each) {
      const Record& record = experiment.record;
      text << experiment.name << " " << record.pressure.size() << "\n";
      for (const double number : {experiment.phi, record.sampling_hz}) {
        text.write(reinterpret_cast<const char*>(&number), sizeof number);
      }
      for (const std::vector<double>* signal : {&record.pressure, &record.heat_release}) {
        text.write(reinterpret_cast<const char*>(signal->data()),
                   static_cast<std::streamsize>(signal->size() * sizeof(double)));
      }
    }
  }
  return text.str();
}

// "a,b" from --without.
std::vector<std::string> Withheld(const Options& options) {
  std::vector<std::string> known;
  for (const EffectPointer& effect : Catalogue()) known.emplace_back(effect->id());
  std::vector<std::string> ids;
  std::istringstream list(options.Text("--without").value_or(""));
  for (std::string id; std::getline(list, id, ',');) {
    if (std::find(known.begin(), known.end(), id) == known.end()) {
      const std::optional<std::string> nearest = NearestKey(id, known);
      throw UsageError("--without: " + id + " is no effect of the catalogue" +
                       (nearest ? ", did you mean " + *nearest + "?" : ""));
    }
    ids.push_back(id);
  }
  return ids;
}

// Nineteen tell one in twenty.
std::size_t Replicates(const Options& options) {
  const std::optional<int> count = options.Count("--bootstrap", 19, 9999);
  if (count && options.Has("--reference")) {
    throw UsageError(
        "--bootstrap simulates the model of the config, and --reference puts records in its "
        "place: expected one or the other");
  }
  return static_cast<std::size_t>(count.value_or(0));
}

int Run(const Options& options) {
  const Config config = LoadConfig(options.config);
  if (std::ranges::none_of(config.experiments,
                           [](const auto& e) { return e.record.has_value(); })) {
    return RunTable(config, options);
  }
  const std::vector<DiagnosisExperiment> experiments = LoadDiagnosisExperiments(config);
  DiagnosisOptions how;
  how.threads = options.threads;
  how.withheld = Withheld(options);
  how.seed = options.seed;
  how.bootstrap = Replicates(options);
  for (const EffectDeclaration& declaration : config.effects) {
    how.further.push_back(std::make_shared<DeclaredEffect>(declaration));
  }
  if (!options.quiet && isatty(STDERR_FILENO) != 0) {
    how.progress = [](std::size_t done, std::size_t total) {
      static ProgressLine line("starts of the search", false);
      line.Show(done, total);
    };
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
  const std::filesystem::path state_path = options.out / "diagnosis.state";
  DiagnoseState state(state_path, Inputs(config, experiments, how.reference));
  if (state.recalled() > 0 && !options.quiet) {
    std::fprintf(stderr, "going on from %s: %zu fits are done\n", state_path.c_str(),
                 state.recalled());
  }
  how.memory = &state;
  how.stopped = IsInterrupted;
  const Diagnosis diagnosis = Diagnose(experiments, how);
  if (diagnosis.stopped) {
    throw Interrupted("interrupted: nothing written; the same command goes on from " +
                      state_path.string());
  }
  const std::filesystem::path path = options.out / "diagnosis.json";
  WriteWholeFile(path, DiagnosisJson(diagnosis).dump(2) + "\n");
  state.Forget();
  if (!options.quiet) {
    PrintDiagnosis(diagnosis);
    std::printf("written: %s\n", path.c_str());
  }
  return kDone;
}

}  // namespace

Command DiagnoseCommand() {
  return {
      "diagnose",
      "say where and why the model falls short of the rig, and by how much",
      "Cuts the loop at its two measured signals (acoustics driven by measured q; delay and\n"
      "flame driven by measured p), refits the model together with each effect of the\n"
      "catalogue, and scores on operating points left out. Needs records with p and q; a table\n"
      "with non-harmonic lines bounds the lag of the q sensor alone.\n"
      "Writes diagnosis.json: the verdict (an effect, none, or unknown), those that the data\n"
      "cannot tell from it, the place, the gap before and after, and every candidate. Effects of\n"
      "your own stand in the config under `effects`.",
      {{"--reference", "SIM.yaml",
        "records of another simulator, or of the rig at another time, in the model's place: which "
        "effect turns them into the config's?"},
       {"--bootstrap", "N",
        "simulate N rigs from the refitted base and search each: what noise alone gains, for "
        "p-values and the verdict none (19 or more)"},
       {"--without", "EFFECTS", "leave these effects (a,b,...) out of the catalogue"}},
      Run,
      true};
}

}  // namespace howl
