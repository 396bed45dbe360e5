#include "rig/output.h"

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace rig {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDigits = 7;

void Append(double value, std::string& text) {
  char buffer[32];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::general, kDigits);
  text.append(buffer, error == std::errc() ? end : buffer);
}

}  // namespace

std::string RecordCsv(const Record& record) {
  std::string text = "p,q\n";
  text.reserve(record.p.size() * 24);
  for (std::size_t i = 0; i < record.p.size(); ++i) {
    Append(record.p[i], text);
    text += ',';
    Append(record.q[i], text);
    text += '\n';
  }
  return text;
}

std::string ConfigYaml(const Spec& spec) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  if (spec.operating_parameter != "phi") {
    out << YAML::Key << "operating_parameter" << YAML::Value << spec.operating_parameter;
  }
  out << YAML::Key << "experiments" << YAML::Value << YAML::BeginSeq;
  for (const Characteristics& each : spec.experiments) {
    out << YAML::Flow << YAML::BeginMap;
    out << YAML::Key << "name" << YAML::Value << YAML::DoubleQuoted << each.name;
    out << YAML::Key << spec.operating_parameter << YAML::Value << each.phi;
    out << YAML::Key << "record" << YAML::Value << YAML::Flow << YAML::BeginMap;
    out << YAML::Key << "file" << YAML::Value << YAML::DoubleQuoted << "data/" + each.name + ".csv";
    out << YAML::Key << "pressure" << YAML::Value << "p";
    out << YAML::Key << "heat_release" << YAML::Value << "q";
    out << YAML::Key << "sampling_hz" << YAML::Value << spec.sampling_hz;
    out << YAML::EndMap << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

std::string KeyJson(const Spec& spec, const Plan& plan, const Grid& grid) {
  Json effects = Json::array();
  for (std::size_t i = 0; i < plan.effects.size(); ++i) {
    const auto& [id, parameters] = plan.effects[i];
    const EffectInfo& info = FindEffect(id);
    std::string block = info.block;
    if (id == "mains_hum") {
      block = plan.behaviour.p_hum != 0.0 ? "p_instrument" : "q_instrument";
    }
    effects.push_back({{"effect", id},
                       {"block", block},
                       {"in_catalogue", info.in_catalogue},
                       {"severity", spec.effects[i].severity},
                       {"size_name", info.size_name},
                       {"size", SizeAt(info, spec.effects[i].severity)},
                       {"parameters", parameters}});
  }
  Json points = Json::array();
  for (std::size_t k = 0; k < plan.points.size(); ++k) {
    const Point& point = plan.points[k];
    const Characteristics& wanted = spec.experiments[k];
    points.push_back({{"name", point.name},
                      {"phi", point.phi},
                      {"omega_hz", point.modes.omega_hz},
                      {"xi", point.modes.xi},
                      {"N", point.modes.N},
                      {"M", point.modes.M},
                      {"tau_s", point.tau_s},
                      {"flame_slope", point.flame.slope},
                      {"loop_gain", point.loop_gain},
                      {"frequency_hz", point.frequency_hz},
                      {"phase_deg", point.phase_deg},
                      {"gain", point.p_amplitude / point.q_amplitude},
                      {"p_amplitude", point.p_amplitude},
                      {"wanted", {{"frequency_hz", wanted.frequency_hz}, {"gain", wanted.gain}}}});
    if (wanted.phase_deg) points.back()["wanted"]["phase_deg"] = *wanted.phase_deg;
  }
  const Flame& flame = plan.points[0].flame;
  const Json key = {{"schema", "howl.rig/1"},
                    {"seed", spec.seed},
                    {"effects", effects},
                    {"flame", FlameShapeNames()[static_cast<std::size_t>(flame.shape)]},
                    {"combustion_noise_relative", plan.combustion_noise},
                    {"combustion_noise_corner_hz", plan.combustion_corner_hz},
                    {"sensor_noise_relative", plan.sensor_noise},
                    {"grid_hz", 1.0 / grid.step_s},
                    {"experiments", points}};
  return key.dump(2) + "\n";
}

std::string EffectsTable() {
  std::string text = "effect,block,in_catalogue,size_name,small,medium,large\n";
  for (const EffectInfo& effect : Effects()) {
    text += effect.id + "," + effect.block + "," + (effect.in_catalogue ? "yes" : "no") + "," +
            effect.size_name;
    for (const double size : {effect.small, effect.medium, effect.large}) {
      text += ",";
      Append(size, text);
    }
    text += "\n";
  }
  return text;
}

void WriteFile(const std::string& path, const std::string& content) {
  const std::filesystem::path target(path);
  if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path());
  const std::string temporary = path + ".part";
  {
    std::ofstream file(temporary, std::ios::binary);
    file << content;
    file.flush();
    if (!file) throw std::runtime_error(path + ": cannot be written");
  }
  std::filesystem::rename(temporary, target);
}

}  // namespace rig
