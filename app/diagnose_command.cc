#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/command.h"
#include "app/record_input.h"
#include "app/text_table.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/table_diagnosis.h"
#include "io/results/diagnosis_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

constexpr double kPerCent = 100.0;
constexpr std::size_t kShownCandidates = 5;
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

std::string ParameterText(const Candidate& candidate) {
  std::string text;
  for (const EstimatedParameter& parameter : candidate.parameters) {
    if (!text.empty()) text += ", ";
    text += parameter.name + " " + Significant(parameter.value, 4);
    if (!parameter.unit.empty()) text += " " + parameter.unit;
  }
  return text;
}

void Print(const Diagnosis& diagnosis) {
  switch (diagnosis.kind) {
    case VerdictKind::kNone:
      std::printf("verdict: none; the model's residuals are noise (probability %.2f)\n",
                  diagnosis.probability_none);
      break;
    case VerdictKind::kUnknown:
      std::printf(
          "verdict: unknown; no effect of the catalogue explains the gap (probability "
          "%.2f)\n",
          diagnosis.probability_unknown);
      break;
    case VerdictKind::kEffect:
      std::printf("verdict: %s (probability %.2f)\n", diagnosis.effect.c_str(),
                  diagnosis.candidates.front().probability);
      for (const std::string& other : diagnosis.indistinguishable) {
        std::printf("  the data cannot tell it from %s\n", other.c_str());
      }
      break;
  }
  for (const Place& place : diagnosis.where) {
    std::printf("where: %s, %.0f to %.0f Hz, %zu experiments (share %.2f)\n",
                std::string(LoopBlockName(place.block)).c_str(), place.low_hz, place.high_hz,
                place.experiments.size(), place.share);
  }
  std::printf("gap, held out: %.3f before, %.3f after; floor %.3f\n", diagnosis.gap_before,
              diagnosis.gap_after, diagnosis.gap_floor);
  TextTable table({"candidate", "probability", "gain", "gap after", "shrinks %", "estimate"});
  for (std::size_t i = 0; i < std::min(kShownCandidates, diagnosis.candidates.size()); ++i) {
    const Candidate& candidate = diagnosis.candidates[i];
    table.AddRow({candidate.effect, Fixed(candidate.probability, 3), Fixed(candidate.gain, 1),
                  Fixed(candidate.gap_after, 3), Fixed(kPerCent * candidate.shrinkage, 1),
                  ParameterText(candidate)});
  }
  std::printf("%s", table.Text().c_str());
  std::printf("next: %s\n", diagnosis.advice.c_str());
}

TableLimits LimitsOfTable(const Config& config) {
  const ModelSpec& model = config.model;
  TableLimits limits;
  limits.modes = model.modes;
  limits.harmonic_ratio = model.harmonic_ratio;
  limits.omega_min_hz = model[ParameterKind::kOmega].min;
  limits.xi_min = model[ParameterKind::kXi].min;
  limits.xi_max = std::min(model[ParameterKind::kXi].max, config.family.test.xi_max);
  if (model.Uses(ParameterKind::kM)) limits.M_max = model[ParameterKind::kM].max;
  if (model.Uses(ParameterKind::kMOverN)) limits.M_over_N_max = model[ParameterKind::kMOverN].max;
  return limits;
}

void PrintTable(const TableDiagnosis& table) {
  std::printf("no records: what the published characteristics say of a lag of the q sensor\n");
  TextTable rows({"experiment", "lag deg", "tau ms without lag", "tau ms"});
  for (const TableExperiment& e : table.experiments) {
    const std::string lag =
        e.lag.any ? Fixed(e.lag.low_deg, 1) + " .. " + Fixed(e.lag.high_deg, 1) : "none";
    rows.AddRow({e.name, lag, Fixed(1e3 * e.tau_s, 3),
                 table.lag.any ? Fixed(1e3 * e.tau_low_s, 3) + " .. " + Fixed(1e3 * e.tau_high_s, 3)
                               : "-"});
  }
  std::printf("%s", rows.Text().c_str());
  if (!table.lag.any) {
    std::printf("table, (3) and the lines agree at no lag between -60 and 60 degrees\n");
    return;
  }
  std::printf("table, (3) and the lines agree for a lag of %.1f to %.1f degrees at %.1f Hz\n",
              table.lag.low_deg, table.lag.high_deg, table.mean_frequency_hz);
  if (std::isfinite(table.cutoff_min_hz)) {
    std::printf("a first-order low-pass on q is cut off at %.0f Hz at least, or compensated\n",
                table.cutoff_min_hz);
  }
  std::printf(
      "verdict: unknown; without records a lag within these bounds cannot be told from a shift\n"
      "between the channels or from none, and no other effect can be seen\n");
}

int RunTable(const Config& config, const Options& options) {
  std::vector<Experiment> experiments;
  for (const ExperimentConfig& one : config.experiments) experiments.push_back(one.experiment);
  const bool any_line =
      std::ranges::any_of(experiments, [](const Experiment& e) { return !e.lines.empty(); });
  if (!any_line) {
    throw UserError(config.source.string(), config.experiments.front().line, "experiments",
                    "no experiment has a record or lines, expected records of p and q, or for "
                    "the lag of the q sensor a non-harmonic line of the table");
  }
  const TableDiagnosis table = DiagnoseTable(experiments, LimitsOfTable(config));
  const std::filesystem::path path = options.out / "diagnosis.json";
  WriteWholeFile(path, TableDiagnosisJson(table).dump(2) + "\n");
  if (!options.quiet) {
    PrintTable(table);
    std::printf("next: %s\nwritten: %s\n", table.diagnosis.advice.c_str(), path.c_str());
  }
  return kDone;
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
  if (!options.quiet && isatty(STDERR_FILENO) != 0) {
    how.progress = [](std::size_t done, std::size_t total) {
      std::fprintf(stderr, "\rcandidates tried: %zu of %zu%s", done, total,
                   done == total ? "\n" : "");
    };
  }
  const Diagnosis diagnosis = Diagnose(experiments, how);
  const std::filesystem::path path = options.out / "diagnosis.json";
  WriteWholeFile(path, DiagnosisJson(diagnosis).dump(2) + "\n");
  if (!options.quiet) {
    Print(diagnosis);
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
      "catalogue, and scores on operating points left out. Needs records with p and q;\n"
      "of a table of characteristics with lines it says which lags of the q sensor they allow.\n"
      "Writes diagnosis.json: the verdict (an effect, none, or unknown), those that the data\n"
      "cannot tell from it, the place, the gap before and after, and every candidate.",
      {},
      Run};
}

}  // namespace howl
