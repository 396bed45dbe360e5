#include "io/results/records_yaml.h"

#include <yaml-cpp/yaml.h>

namespace howl {

std::string RecordsYaml(const Config& config, const std::vector<Experiment>& experiments,
                        double sampling_hz) {
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << YAML::BeginMap;
  out << YAML::Key << "title" << YAML::Value << "simulated: " + config.title;
  if (config.operating_parameter != "phi") {
    out << YAML::Key << "operating_parameter" << YAML::Value << config.operating_parameter;
  }
  out << YAML::Key << "experiments" << YAML::Value << YAML::BeginSeq;
  for (const Experiment& experiment : experiments) {
    out << YAML::BeginMap;
    out << YAML::Key << "name" << YAML::Value << YAML::DoubleQuoted << experiment.name;
    out << YAML::Key << config.operating_parameter << YAML::Value << experiment.phi;
    out << YAML::Key << "record" << YAML::Value << YAML::Flow << YAML::BeginMap;
    out << YAML::Key << "file" << YAML::Value << YAML::DoubleQuoted << experiment.name + ".csv";
    out << YAML::Key << "pressure" << YAML::Value << "p";
    out << YAML::Key << "heat_release" << YAML::Value << "q";
    out << YAML::Key << "sampling_hz" << YAML::Value << sampling_hz;
    out << YAML::EndMap << YAML::EndMap;
  }
  out << YAML::EndSeq;
  out << YAML::Key << "model" << YAML::Value << YAML::Flow << YAML::BeginMap;
  out << YAML::Key << "modes" << YAML::Value << config.model.modes;
  out << YAML::Key << "harmonic_ratio" << YAML::Value << config.model.harmonic_ratio;
  out << YAML::EndMap << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace howl
