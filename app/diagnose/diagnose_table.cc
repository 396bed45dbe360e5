#include "app/diagnose/diagnose_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/text/text_table.h"
#include "diagnosis/table/table_diagnosis.h"
#include "io/results/diagnosis_json.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

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

}  // namespace

int RunTable(const Config& config, const Options& options) {
  for (const char* option : {"--bootstrap", "--reference", "--without"}) {
    if (options.Has(option)) {
      throw UsageError(std::string(option) +
                       " needs records of p and q: " + config.source.string() + " is a table");
    }
  }
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

}  // namespace howl
