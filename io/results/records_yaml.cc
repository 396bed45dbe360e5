#include "io/results/records_yaml.h"

#include <yaml-cpp/yaml.h>

#include <set>
#include <utility>
#include <vector>

#include "io/config/yaml/yaml_text.h"

namespace howl {
namespace {

// The sections of the config that state the problem, in addition to its experiments; they are
// copied because the records belong to the same problem.
constexpr const char* kSections[] = {"residuals", "solver", "family", "analysis"};

// A section as it is in the config, except names of experiments that are not among the records.
LocatedNode Without(const std::set<std::string>& left_out, LocatedNode node) {
  std::erase_if(node.items, [&](const LocatedNode& item) { return left_out.contains(item.text); });
  for (LocatedNode& item : node.items) item = Without(left_out, std::move(item));
  for (LocatedMember& member : node.members) {
    member.value = Without(left_out, std::move(member.value));
  }
  return node;
}

LocatedNode& Value(const std::string& key, LocatedNode* mapping) {
  for (LocatedMember& member : mapping->members) {
    if (member.key == key) return member.value;
  }
  mapping->kind = LocatedNode::Kind::kMapping;
  mapping->members.push_back({.key = key, .key_line = 1, .value = {}});
  return mapping->members.back().value;
}

// The config's parameters, with the scope of the delays stated, which the simulation determined.
LocatedNode Parameters(const Config& config) {
  const LocatedMember* const stated = config.tree.Find("parameters");
  LocatedNode out = stated == nullptr ? LocatedNode() : stated->value;
  LocatedNode& scope = Value("scope", &Value("tau_s", &out));
  if (scope.kind == LocatedNode::Kind::kNull) {
    const bool shared = config.model[ParameterKind::kTau].scope == ParameterScope::kShared;
    scope = MakeScalar(shared ? "shared" : "experiment", false, 1);
  }
  return out;
}

}  // namespace

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
  out << YAML::Key << "model" << YAML::Value;
  if (config.record_loop) {
    EmitYaml(config.tree.Find("model")->value, out);
  } else {
    out << YAML::Flow << YAML::BeginMap;
    out << YAML::Key << "modes" << YAML::Value << config.model.modes;
    out << YAML::Key << "harmonic_ratio" << YAML::Value << config.model.harmonic_ratio;
    out << YAML::EndMap;
  }
  std::set<std::string> left_out;
  for (const ExperimentConfig& each : config.experiments) left_out.insert(each.experiment.name);
  for (const Experiment& experiment : experiments) left_out.erase(experiment.name);
  // A loop that is fitted to whole records takes none.
  if (!config.record_loop) {
    out << YAML::Key << "parameters" << YAML::Value;
    EmitYaml(Without(left_out, Parameters(config)), out);
  }
  for (const char* const section : kSections) {
    const LocatedMember* const member = config.tree.Find(section);
    if (member == nullptr) continue;
    out << YAML::Key << section << YAML::Value;
    EmitYaml(Without(left_out, member->value), out);
  }
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace howl
