#include "rig/spec.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>

namespace rig {
namespace {

class Reader {
 public:
  explicit Reader(std::string path) : path_(std::move(path)) {}

  [[noreturn]] void Fail(const YAML::Node& node, const std::string& key,
                         const std::string& what) const {
    const int line = node ? node.Mark().line + 1 : 0;
    throw SpecError(path_ + ":" + (line > 0 ? std::to_string(line) + ":" : "") + " " + key + ": " +
                    what);
  }

  void Keys(const YAML::Node& node, const std::string& where,
            const std::set<std::string>& known) const {
    if (!node.IsMap()) Fail(node, where, "is no map, expected keys and values");
    for (const auto& entry : node) {
      const auto key = entry.first.as<std::string>();
      if (known.contains(key)) continue;
      std::string all;
      for (const std::string& each : known) all += (all.empty() ? "" : ", ") + each;
      Fail(entry.first, key, "is not a known key of " + where + ", expected one of " + all);
    }
  }

  double Number(const YAML::Node& parent, const std::string& key, double otherwise, double low,
                double high) const {
    const YAML::Node node = parent[key];
    if (!node) return otherwise;
    double value = 0.0;
    if (!YAML::convert<double>::decode(node, value) || !(value >= low && value <= high)) {
      Fail(node, key, "expected a number from " + Text(low) + " to " + Text(high));
    }
    return value;
  }

  std::string Word(const YAML::Node& parent, const std::string& key,
                   const std::string& otherwise) const {
    const YAML::Node node = parent[key];
    if (!node) return otherwise;
    if (!node.IsScalar()) Fail(node, key, "expected a word");
    return node.as<std::string>();
  }

 private:
  static std::string Text(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }

  std::string path_;
};

Characteristics ReadExperiment(const Reader& reader, const YAML::Node& node, std::size_t index) {
  reader.Keys(node, "experiments", {"name", "phi", "frequency_hz", "phase_deg", "gain"});
  Characteristics out;
  out.name = reader.Word(node, "name", "exp" + std::to_string(index + 1));
  if (out.name.find('/') != std::string::npos) {
    reader.Fail(node["name"], "name", "has a slash, expected a word that can name a file");
  }
  if (!node["frequency_hz"]) reader.Fail(node, "frequency_hz", "is missing");
  out.phi = reader.Number(node, "phi", static_cast<double>(index), -1e9, 1e9);
  out.frequency_hz = reader.Number(node, "frequency_hz", 0.0, 1.0, 1e5);
  if (node["phase_deg"]) out.phase_deg = reader.Number(node, "phase_deg", 0.0, -360.0, 360.0);
  out.gain = reader.Number(node, "gain", 10.0, 1e-12, 1e12);
  return out;
}

EffectRequest ReadEffect(const Reader& reader, const YAML::Node& node) {
  reader.Keys(node, "effects", {"id", "severity", "parameters"});
  EffectRequest out;
  out.id = reader.Word(node, "id", "");
  try {
    FindEffect(out.id);
  } catch (const std::runtime_error& error) {
    reader.Fail(node, "id", error.what());
  }
  const std::string severity = reader.Word(node, "severity", "medium");
  if (severity == "small") {
    out.severity = 0.25;
  } else if (severity == "medium") {
    out.severity = 0.55;
  } else if (severity == "large") {
    out.severity = 0.85;
  } else {
    out.severity = reader.Number(node, "severity", 0.55, 0.0, 1.0);
  }
  if (const YAML::Node values = node["parameters"]) {
    if (!values.IsMap()) reader.Fail(values, "parameters", "expected names and numbers");
    out.parameters.emplace();
    for (const auto& entry : values) {
      double value = 0.0;
      const auto name = entry.first.as<std::string>();
      if (!YAML::convert<double>::decode(entry.second, value)) {
        reader.Fail(entry.second, name, "expected a number");
      }
      (*out.parameters)[name] = value;
    }
    Behaviour ignored;
    try {
      ApplyEffect(out.id, *out.parameters, ignored);
    } catch (const std::runtime_error& error) {
      reader.Fail(values, "parameters", error.what());
    }
  }
  return out;
}

}  // namespace

Spec LoadSpec(const std::string& path) {
  const Reader reader(path);
  YAML::Node root;
  try {
    root = YAML::LoadFile(path);
  } catch (const YAML::BadFile&) {
    throw SpecError(path + ": cannot be read");
  } catch (const YAML::Exception& error) {
    throw SpecError(path + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
  reader.Keys(root, "the rig",
              {"experiments", "effects", "seed", "duration_s", "sampling_hz", "settle_s", "scatter",
               "flame", "refine", "operating_parameter", "noise"});
  Spec spec;
  const YAML::Node experiments = root["experiments"];
  if (!experiments || !experiments.IsSequence() || experiments.size() == 0) {
    reader.Fail(experiments ? experiments : root, "experiments",
                "expected a list of at least one experiment");
  }
  std::set<std::string> names;
  for (const YAML::Node& node : experiments) {
    spec.experiments.push_back(ReadExperiment(reader, node, spec.experiments.size()));
    if (!names.insert(spec.experiments.back().name).second) {
      reader.Fail(node, "name", spec.experiments.back().name + " is there twice");
    }
  }
  const YAML::Node effects = root["effects"];
  if (effects && !effects.IsSequence()) {
    reader.Fail(effects, "effects", "expected a list of effects");
  }
  for (const YAML::Node& node : effects) spec.effects.push_back(ReadEffect(reader, node));
  if (const YAML::Node seed = root["seed"]) {
    if (!YAML::convert<std::uint64_t>::decode(seed, spec.seed)) {
      reader.Fail(seed, "seed", "expected a whole number from 0 to 2^64 - 1");
    }
  }
  spec.duration_s = reader.Number(root, "duration_s", spec.duration_s, 0.05, 1e4);
  spec.sampling_hz = reader.Number(root, "sampling_hz", spec.sampling_hz, 100.0, 1e6);
  spec.settle_s = reader.Number(root, "settle_s", spec.settle_s, 0.0, 1e3);
  spec.refine = static_cast<int>(reader.Number(root, "refine", 1.0, 1.0, 64.0));
  spec.operating_parameter = reader.Word(root, "operating_parameter", "phi");
  const std::string scatter = reader.Word(root, "scatter", "true");
  if (scatter != "true" && scatter != "false") {
    reader.Fail(root["scatter"], "scatter", "expected true or false");
  }
  spec.scatter = scatter == "true";
  const std::string flame = reader.Word(root, "flame", "any");
  if (flame != "any") {
    const std::vector<std::string>& shapes = FlameShapeNames();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (shapes[i] == flame) spec.flame = static_cast<FlameShape>(i);
    }
    if (!spec.flame) {
      reader.Fail(root["flame"], "flame",
                  "expected any, tanh, arctan, erf, rational or asymmetric");
    }
  }
  if (const YAML::Node noise = root["noise"]) {
    reader.Keys(noise, "noise", {"combustion_relative", "sensor_relative"});
    if (noise["combustion_relative"]) {
      spec.combustion_noise = reader.Number(noise, "combustion_relative", 0.0, 0.0, 10.0);
    }
    if (noise["sensor_relative"]) {
      spec.sensor_noise = reader.Number(noise, "sensor_relative", 0.0, 0.0, 10.0);
    }
  }
  return spec;
}

}  // namespace rig
