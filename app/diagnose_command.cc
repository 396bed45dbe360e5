#include <unistd.h>

#include <cstdio>

#include "app/command.h"
#include "app/progress_line.h"
#include "app/record_input.h"
#include "app/text_table.h"
#include "diagnosis/diagnosis.h"
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

int Run(const Options& options) {
  const Config config = LoadConfig(options.config);
  const std::vector<DiagnosisExperiment> experiments = LoadDiagnosisExperiments(config);
  DiagnosisOptions how;
  how.threads = options.threads;
  if (!options.quiet && isatty(STDERR_FILENO) != 0) {
    how.progress = [](std::size_t done, std::size_t total) {
      static ProgressLine line("candidates tried", false);
      line.Show(done, total);
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
  return {"diagnose",
          "say where and why the model falls short of the rig, and by how much",
          "Cuts the loop at its two measured signals (acoustics driven by measured q; delay and\n"
          "flame driven by measured p), refits the model together with each effect of the\n"
          "catalogue, and scores on operating points left out. Needs records with p and q.\n"
          "Writes diagnosis.json: the verdict (an effect, none, or unknown), those that the data\n"
          "cannot tell from it, the place, the gap before and after, and every candidate.",
          {},
          Run};
}

}  // namespace howl
