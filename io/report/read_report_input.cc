#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

#include "io/config/reading/config_reading.h"
#include "io/json_text.h"
#include "io/records/records.h"
#include "io/report/fault_words.h"
#include "io/report/read_measured.h"
#include "io/report/report_input.h"
#include "io/result_files.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

using Json = nlohmann::json;

constexpr double kMostHarmonic = 1000.0;

// Runs `read` where the file is there; a fault becomes a note, an absent file is left to `absent`.
void Try(ReportInput& input, const char* file, const char* command,
         const std::function<void(const std::filesystem::path&)>& read) {
  const std::filesystem::path path = input.folder / file;
  if (!std::filesystem::exists(path)) return;
  try {
    read(path);
  } catch (const std::exception& error) {
    input.missing.push_back(std::string(file) + " is not usable (" + FaultWords(error) +
                            "); howl " + command + " writes it anew");
  }
}

Json ReadJson(const std::filesystem::path& path, const std::string& schema) {
  std::ifstream file(path);
  Json json = ParseJsonOrNone<Json>(file);
  if (json.is_discarded() || !json.is_object()) throw std::runtime_error("half written");
  const std::string found = json.contains("schema") && json["schema"].is_string()
                                ? json["schema"].get<std::string>()
                                : std::string();
  if (found != schema) {
    throw std::runtime_error("its schema is \"" + found + "\", expected " + schema);
  }
  return json;
}

// The config where it was when the commands ran; else the text that they kept.
void ReadConfig(ReportInput& input) {
  Try(input, "run.json", "fit",
      [&](const std::filesystem::path&) { input.run = ReadRunFile(input.folder); });
  if (!input.run) {
    if (!std::filesystem::exists(input.folder / "run.json") &&
        !std::filesystem::exists(input.folder / "trial.json") &&
        !std::filesystem::exists(input.folder / "campaign.json")) {
      input.missing.push_back(
          "run.json, which names the config, is not here: records, tests and priors are unknown; "
          "any command of howl run on the config writes it");
    }
    return;
  }
  const RunFile& run = *input.run;
  try {
    if (std::filesystem::is_regular_file(run.config)) {
      if (ReadWholeFile(run.config).value_or("") != run.config_text) {
        input.missing.push_back(
            "the config has changed since the last command ran: what the "
            "files hold may belong to its former text");
      }
      input.config = LoadConfig(run.config, LoopsTaken::kAny);
    } else {
      const auto copy = std::filesystem::temp_directory_path() /
                        ("howl_report_" + std::to_string(getpid()) + ".yaml");
      WriteWholeFile(copy, run.config_text);
      try {
        input.config = LoadConfig(copy, LoopsTaken::kAny);
      } catch (...) {
        std::filesystem::remove(copy);
        throw;
      }
      std::filesystem::remove(copy);
      input.missing.push_back("the config " + run.config.filename().string() +
                              " is no longer where it was: its kept text is used, and records "
                              "that it names by a relative path are out of reach");
    }
  } catch (const std::exception& error) {
    input.missing.push_back(std::string("the config is not usable: ") + error.what());
  }
}

void ReadPublishedLines(ReportInput& input) {
  if (!input.config) return;
  for (const ExperimentConfig& each : input.config->experiments) {
    for (const ObservedLine& line : each.experiment.lines) {
      input.lines.push_back({each.experiment.name,
                             each.experiment.phi,
                             {line.frequency_hz, line.frequency_std_hz},
                             0});
    }
  }
}

void ReadLines(ReportInput& input, const std::filesystem::path& path) {
  const CsvTable table = ReadCsvTable(path);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    // The cell of a line that is no multiple of the fundamental is empty.
    const bool none = table.Text(row, "harmonic").empty();
    const double harmonic = none ? 0.0 : table.Number(row, "harmonic");
    if (!(harmonic >= 0.0 && harmonic <= kMostHarmonic)) {
      throw std::runtime_error("a harmonic that is no whole number from 0 to 1000");
    }
    input.lines.push_back(
        {table.Text(row, "name"),
         table.Number(row, "phi"),
         {table.Number(row, "frequency_hz"), table.Number(row, "frequency_std_hz")},
         static_cast<int>(harmonic)});
  }
}

void ReadRecords(ReportInput& input, const Config& config, std::vector<NamedRecord>& records) {
  std::string first_fault;
  int faults = 0;
  for (const ExperimentConfig& each : config.experiments) {
    if (!each.record) continue;
    try {
      records.push_back({each.experiment.name, each.experiment.phi,
                         LoadRecord(*each.record, config.source.string(), each.record_line),
                         each.cycle_hz});
    } catch (const std::exception& error) {
      if (++faults == 1) first_fault = error.what();
    }
  }
  if (faults > 0) {
    input.missing.push_back(std::to_string(faults) + " of the records could not be read: " +
                            first_fault + (faults > 1 ? " ..." : ""));
  }
}

void ReadFitted(ReportInput& input) {
  for (const Json& row : ListAt(input.solution, "experiments")) {
    // The figures are of the paper's loop, which this one is not.
    if (row.contains("modes")) continue;
    LoopModel model{.omega_hz = NumberAt(row, "omega_hz"),
                    .xi = NumberAt(row, "xi"),
                    .N = NumberAt(row, "N"),
                    .M = NumberAt(row, "M"),
                    .tau_s = NumberAt(row, "tau_s"),
                    .harmonic_ratio = row.value("harmonic_ratio", kPaperHarmonicRatio)};
    if (std::isnan(model.M)) model.M = 0.0;
    const bool whole = model.omega_hz > 0.0 && model.xi > 0.0 && model.N > 0.0 && model.tau_s > 0.0;
    if (whole) input.fitted.push_back({row.value("name", ""), NumberAt(row, "phi"), model});
  }
}

void NoteAbsent(ReportInput& input) {
  struct Source {
    const char* file;
    const char* command;
    const char* what;
    bool needs_records;
  };
  const bool has_records =
      input.config && std::ranges::any_of(input.config->experiments,
                                          [](const auto& each) { return each.record.has_value(); });
  // A trial stands alone, and so does a campaign.
  if ((input.trial.is_object() || input.campaign.is_object()) && input.solution.is_null() &&
      input.analysis.is_null())
    return;
  for (const Source& source :
       {Source{"analysis.json", "analyse", "spectral lines, flame curves and transfers", true},
        Source{"solution.json", "fit", "the fitted loops", false},
        Source{kFamilyCsv, "family", "what the data cannot reject, and the browser", false},
        Source{"diagnosis.json", "diagnose", "where and why the model falls short", true}}) {
    if (source.needs_records && !has_records) continue;
    if (!std::filesystem::exists(input.folder / source.file)) {
      input.missing.push_back(std::string("howl ") + source.command +
                              " has not run here: " + source.what + " (" + source.file + ")");
    }
  }
}

}  // namespace

ReportInput ReadReportInput(const std::filesystem::path& folder, int threads) {
  if (!std::filesystem::is_directory(folder)) {
    throw UserError(folder.string(), 0, "",
                    "no such folder, expected one that the other commands wrote to");
  }
  ReportInput input;
  input.folder = folder;
  ReadConfig(input);
  Try(input, "analysis.json", "analyse",
      [&](const auto& path) { input.analysis = ReadJson(path, "howl.analysis/1"); });
  Try(input, "solution.json", "fit", [&](const auto& path) {
    input.solution = ReadJson(path, "howl.solution/1");
    ReadFitted(input);
  });
  Try(input, "family.json", "family",
      [&](const auto& path) { input.family = ReadJson(path, "howl.family/1"); });
  Try(input, "simulation.json", "simulate",
      [&](const auto& path) { input.simulation = ReadJson(path, "howl.simulation/1"); });
  Try(input, "diagnosis.json", "diagnose",
      [&](const auto& path) { input.diagnosis = ReadJson(path, "howl.diagnosis/1"); });
  Try(input, "prediction.json", "predict",
      [&](const auto& path) { input.prediction = ReadJson(path, "howl.prediction/1"); });
  Try(input, kPredictionMapCsv, "predict",
      [&](const auto& path) { input.prediction_map = ReadCsvTable(path); });
  Try(input, "trial.json", "trial",
      [&](const auto& path) { input.trial = ReadJson(path, "howl.trial/1"); });
  Try(input, "campaign.json", "campaign",
      [&](const auto& path) { input.campaign = ReadJson(path, "howl.campaign/1"); });
  Try(input, kCampaignCsv, "campaign",
      [&](const auto& path) { input.campaign_table = ReadCsvTable(path); });
  Try(input, kCampaignPointsCsv, "campaign",
      [&](const auto& path) { input.campaign_points = ReadCsvTable(path); });
  Try(input, kTransferCsv, "analyse",
      [&](const auto& path) { input.transfer = ReadCsvTable(path); });
  Try(input, kFlameCurveCsv, "analyse",
      [&](const auto& path) { input.flame_curve = ReadCsvTable(path); });
  // An empty family has neither members nor a trade-off.
  if (!input.FamilyIsEmpty()) {
    Try(input, kTradeoffCsv, "family",
        [&](const auto& path) { input.tradeoff = ReadCsvTable(path); });
  }
  Try(input, kTrialCsv, "trial", [&](const auto& path) { input.trial_table = ReadCsvTable(path); });
  Try(input, kLinesCsv, "analyse", [&](const auto& path) { ReadLines(input, path); });
  Try(input, kFamilyCsv, "family", [&](const auto& path) {
    const FamilyTable table = ReadFamilyCsv(path);
    if (table.rows.empty()) return;
    input.members = MakeFamilyMembers(
        table, input.config ? input.config->model.harmonic_ratio : kPaperHarmonicRatio);
  });
  if (input.config) {
    input.title = input.config->title;
    input.operating_parameter = input.config->operating_parameter;
    ReadRecords(input, *input.config, input.records);
  }
  if (input.campaign.is_object()) input.title = TextAt(input.campaign, "title");
  if (input.title.empty()) input.title = folder.lexically_normal().filename().string();
  try {
    input.measured = ReadMeasured(input);
  } catch (const std::exception& error) {
    input.missing.push_back("the characteristics are left out: " + FaultWords(error));
  }
  ReadPublishedLines(input);
  Try(input, "records.yaml", "simulate", [&](const auto& path) {
    // If the config is this very records.yaml, its records would be compared with themselves.
    if (input.config && std::filesystem::weakly_canonical(input.config->source) ==
                            std::filesystem::weakly_canonical(path)) {
      return;
    }
    ReadRecords(input, LoadConfig(path), input.simulated);
    AnalysisOptions options;
    options.threads = threads;
    input.simulated_analysis = AnalyseRecords(input.simulated, options);
  });
  const bool empty = !input.run && input.analysis.is_null() && input.solution.is_null() &&
                     input.family.is_null() && input.diagnosis.is_null() && input.trial.is_null() &&
                     input.campaign.is_null() && !input.members && input.simulated.empty();
  if (empty && input.missing.size() <= 1) {
    throw UserError(folder.string(), 0, "",
                    "holds nothing to report, expected files that the other commands wrote");
  }
  NoteAbsent(input);
  return input;
}

}  // namespace howl
