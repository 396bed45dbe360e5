// The input of a report: the files that the other commands wrote to one folder, and the config that
// they ran. Whatever is missing or half written leaves its place empty and a note saying so;
// the rest of the report does not depend on it.
#ifndef HOWL_IO_REPORT_REPORT_INPUT_H_
#define HOWL_IO_REPORT_REPORT_INPUT_H_

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "estimation/analysis/analyse.h"
#include "estimation/family/answers/tradeoff.h"
#include "estimation/parameters.h"
#include "io/config/config.h"
#include "io/json_fields.h"
#include "io/report/csv_table.h"
#include "io/report/family_members.h"
#include "io/report/run_file.h"

namespace howl {

// One experiment as measured: published in the config, or analysed from its record. Estimates are
// NaN where they do not apply or are not known.
struct MeasuredPoint {
  std::string name;
  double phi = 0.0;
  Estimate frequency_hz, phase_deg, gain, tau_s, flame_slope, loop_gain;
  bool reliable = true;

  bool has_cycle() const { return frequency_hz.value > 0.0; }
};

// A spectral line of an experiment: harmonic 0 is none of the fundamental's.
struct MeasuredLine {
  std::string experiment;
  double phi = 0.0;
  Estimate frequency_hz;
  int harmonic = 0;
};

struct ExperimentModel {
  std::string name;
  double phi = 0.0;
  LoopModel model;
};

struct ReportInput {
  std::filesystem::path folder;
  std::optional<RunFile> run;
  std::optional<Config> config;
  std::string title;
  std::string operating_parameter = "phi";

  std::vector<MeasuredPoint> measured;
  std::vector<MeasuredLine> lines;
  std::vector<NamedRecord> records;    // measured
  std::vector<NamedRecord> simulated;  // what howl simulate wrote
  AnalysisSet simulated_analysis;

  std::vector<ExperimentModel> fitted;  // of solution.json
  // Null where there is none.
  nlohmann::json analysis, solution, family, prediction, simulation, diagnosis, trial, campaign;
  std::optional<CsvTable> transfer, flame_curve, tradeoff, prediction_map, trial_table,
      campaign_table, campaign_points;
  std::optional<FamilyMembers> members;

  std::vector<std::string> missing;  // sentences for the reader

  // howl family ran and found no member.
  bool FamilyIsEmpty() const;
  const MeasuredPoint* Measured(const std::string& name) const;
  const ExperimentModel* Fitted(const std::string& name) const;
  const NamedRecord* RecordOf(const std::string& name) const;
  const NamedRecord* SimulatedOf(const std::string& name) const;
  // The experiment that stands for all where one is enough: the first reliable one with a limit
  // cycle, a model before none. Null without any.
  const MeasuredPoint* Reference() const;
  // "equivalence ratio phi", or the config's key with its unit in brackets.
  std::string OperatingLabel() const;
};

// Throws UserError where the folder is missing or holds nothing that a command wrote.
ReportInput ReadReportInput(const std::filesystem::path& folder, int threads);

Estimate EstimateAt(const nlohmann::json& json, const char* key);

}  // namespace howl

#endif  // HOWL_IO_REPORT_REPORT_INPUT_H_
