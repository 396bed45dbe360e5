// The config: one YAML file that states a problem. Only `experiments` is needed; all else has the
// defaults of the structs below, which the schema (io/config/schema/config_schema.json) repeats.
// Keys carry their unit; what the options of a command set (seed, threads, output folder) is not
// here.
#ifndef HOWL_IO_CONFIG_CONFIG_H_
#define HOWL_IO_CONFIG_CONFIG_H_

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "estimation/analysis/analysis_spec.h"
#include "estimation/analysis/cycle/cycle_band.h"
#include "estimation/analysis/loop/experiment.h"
#include "estimation/family/problem/family_spec.h"
#include "estimation/fit/solver_spec.h"
#include "estimation/joint_records/record_loop_spec.h"
#include "estimation/parameters.h"
#include "estimation/residual_spec.h"
#include "io/config/simulation_spec.h"
#include "io/config/yaml/located_node.h"
#include "io/record_spec.h"
#include "model/effects/declared_effect.h"

namespace howl {

struct ExperimentConfig {
  Experiment experiment;              // where a record is given: name, phi and reliable alone
  std::optional<RecordSpec> record;   // to be analysed first
  std::optional<CycleBand> cycle_hz;  // of the record: its own, or the config's
  int line = 0;                       // of the experiment in the config
  int record_line = 0;                // of record.file; 0 without a record
};

struct Config {
  std::filesystem::path source;
  std::string title;
  std::string operating_parameter = "phi";  // the key that experiments carry in place of phi
  std::vector<ExperimentConfig> experiments;
  ModelSpec model = DefaultModelSpec();
  std::optional<RecordLoopSpec> record_loop;  // where `model` states more than the paper's loop
  int model_line = 0;                         // of the section; 0 without
  ResidualSet residuals = DefaultResidualSet();
  SolverSpec solver;
  FamilySpec family;
  AnalysisSpec analysis;
  SimulationSpec simulation;
  std::vector<EffectDeclaration> effects;  // of the user's own
  LocatedNode tree;                        // the file as it was written
};

}  // namespace howl

#endif  // HOWL_IO_CONFIG_CONFIG_H_
