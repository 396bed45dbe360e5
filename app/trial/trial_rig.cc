#include "app/trial/trial_rig.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/input/problem_input.h"
#include "app/input/record_input.h"
#include "app/process/child_process.h"
#include "io/user_error.h"

namespace howl {
namespace {

constexpr int kExactDigits = 17;

std::string RigProgram() { return (ProgramFolder() / "howl_rig").string(); }

void RequirePositive(const Options& options, const std::string& name, double* value) {
  const std::optional<double> given = options.Number(name);
  if (!given) return;
  if (!(*given > 0.0)) throw UsageError(name + ": expected a positive number");
  *value = *given;
}

std::optional<double> NotNegative(const Options& options, const std::string& name) {
  const std::optional<double> given = options.Number(name);
  if (given && *given < 0.0) throw UsageError(name + ": expected no negative number");
  return given;
}

}  // namespace

RigTemplate MakeRigTemplate(const Config& config, const Options& options) {
  RigTemplate rig_template;
  rig_template.experiments = LoadExperiments(config, options);
  rig_template.operating_parameter = config.operating_parameter;
  const SimulationTimes times = MakeSimulationTimes(config.simulation, rig_template.experiments);
  rig_template.duration_s = times.duration_s;
  rig_template.sampling_hz = times.sampling_hz;
  rig_template.settle_s = times.settle_s;
  const std::vector<NamedRecord> records = LoadRecords(config);
  if (!records.empty()) {
    // The shortest duration, because it limits the diagnosis.
    rig_template.duration_s = 1e9;
    rig_template.sampling_hz = records.front().record.sampling_hz;
    for (const NamedRecord& each : records) {
      rig_template.duration_s =
          std::min(rig_template.duration_s,
                   static_cast<double>(each.record.pressure.size()) / each.record.sampling_hz);
    }
  }
  RequirePositive(options, "--duration", &rig_template.duration_s);
  RequirePositive(options, "--sampling", &rig_template.sampling_hz);
  rig_template.combustion_noise = NotNegative(options, "--combustion-noise");
  rig_template.sensor_noise = NotNegative(options, "--sensor-noise");
  const int all = static_cast<int>(rig_template.experiments.size());
  if (const auto wanted = options.Count("--experiments", 1, all)) {
    // The chosen experiments are spread over the range.
    std::vector<Experiment> chosen;
    for (int i = 0; i < *wanted; ++i) {
      const double place = *wanted > 1 ? static_cast<double>(i) * (all - 1) / (*wanted - 1) : 0.0;
      chosen.push_back(rig_template.experiments[static_cast<std::size_t>(std::lround(place))]);
    }
    rig_template.experiments = std::move(chosen);
  }
  return rig_template;
}

std::string RigSpecYaml(const RigTemplate& rig_template, const CasePlan& plan) {
  YAML::Emitter out;
  out.SetDoublePrecision(kExactDigits);
  out << YAML::BeginMap << YAML::Key << "experiments" << YAML::Value << YAML::BeginSeq;
  for (const Experiment& each : rig_template.experiments) {
    out << YAML::Flow << YAML::BeginMap;
    out << YAML::Key << "name" << YAML::Value << YAML::DoubleQuoted << each.name;
    out << YAML::Key << "phi" << YAML::Value << each.phi;
    out << YAML::Key << "frequency_hz" << YAML::Value << each.frequency_hz;
    out << YAML::Key << "phase_deg" << YAML::Value << each.phase_deg;
    out << YAML::Key << "gain" << YAML::Value << each.gain << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::Key << "effects" << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const std::string& effect : plan.effects) {
    out << YAML::Flow << YAML::BeginMap << YAML::Key << "id" << YAML::Value << effect << YAML::Key
        << "severity" << YAML::Value << plan.severity << YAML::EndMap;
  }
  out << YAML::EndSeq;
  out << YAML::Key << "seed" << YAML::Value << plan.rig_seed;
  out << YAML::Key << "duration_s" << YAML::Value << rig_template.duration_s;
  out << YAML::Key << "sampling_hz" << YAML::Value << rig_template.sampling_hz;
  out << YAML::Key << "settle_s" << YAML::Value << rig_template.settle_s;
  out << YAML::Key << "operating_parameter" << YAML::Value << rig_template.operating_parameter;
  out << YAML::Key << "noise" << YAML::Value << YAML::Flow << YAML::BeginMap;
  if (rig_template.combustion_noise) {
    out << YAML::Key << "combustion_relative" << YAML::Value << *rig_template.combustion_noise;
  }
  if (rig_template.sensor_noise) {
    out << YAML::Key << "sensor_relative" << YAML::Value << *rig_template.sensor_noise;
  }
  out << YAML::EndMap << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

std::vector<RigEffect> ListRigEffects() {
  const ChildResult list = RunChild({RigProgram(), "--list"}, "");
  std::istringstream lines(list.out);
  std::string line;
  std::getline(lines, line);  // the header
  std::vector<RigEffect> effects;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (row.size() != 7) continue;
    effects.push_back({row[0],
                       row[1],
                       row[2] == "yes",
                       row[3],
                       {std::stod(row[4]), std::stod(row[5]), std::stod(row[6])}});
  }
  if (effects.empty()) throw UserError(RigProgram(), 0, "", "lists no effects");
  return effects;
}

nlohmann::json MakeRig(const RigTemplate& rig_template, const CasePlan& plan,
                       const std::filesystem::path& folder) {
  const ChildResult made = RunChild({RigProgram(), "/dev/stdin", "--out", folder.string()},
                                    RigSpecYaml(rig_template, plan));
  if (made.status != 0) {
    throw UserError(RigProgram(), 0, "", "could not make " + plan.name + ": " + made.err);
  }
  return nlohmann::json::parse(made.out);
}

}  // namespace howl
