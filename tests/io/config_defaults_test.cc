// The schema's defaults are the structs' defaults, and a config with experiments alone has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "estimation/residuals/registry.h"
#include "io/config/reading/config_reading.h"
#include "io/config/schema/config_schema.h"
#include "io/config/schema/nearest_key.h"
#include "io/config/sections/config_sections.h"
#include "tests/io/config_file.h"

namespace howl::config_defaults_test {
namespace {

using Json = nlohmann::json;

// Values are compared as JSON text, which keeps a whole number and a number apart.
using Defaults = std::map<std::string, std::string>;

template <typename T>
std::string Dump(const T& value) {
  return Json(value).dump();
}

// What each "default" of the schema should be, by the schema's key path, from the structs.
Defaults StructDefaults() {
  const ConfigFile file(
      "experiments:\n  - {name: a, phi: 1, frequency_hz: 1, phase_deg: 1, gain: 1}\n");
  const Config config = LoadConfig(file.Path());
  const RecordSpec record;
  Defaults defaults = {
      {"title", Dump(config.title)},
      {"operating_parameter", Dump(config.operating_parameter)},
      {"experiments[].reliable", Dump(config.experiments[0].experiment.reliable)},
      {"experiments[].lines[].frequency_std_hz", Dump(ObservedLine().frequency_std_hz)},
      {"experiments[].record.pressure", Dump(record.pressure)},
      {"experiments[].record.pressure_scale", Dump(record.pressure_scale)},
      {"experiments[].record.heat_release_scale", Dump(record.heat_release_scale)},
      {"experiments[].record.start_s", Dump(record.start_s)},
      {"experiments[].record.delay_s", Dump(record.delay_s)},
      {"experiments[].record.pressure_in_heat_release", Dump(record.pressure_in_heat_release)},
      {"model.modes", Dump(config.model.modes)},
      {"model.ratio", Dump(config.model.harmonic_ratio)},
      // Without them the loop is the paper's, which ConfigRecordLoop tests.
      {"model.damping", Dump("shared")},
      {"model.residue", Dump("real")},
      {"model.flame_input", Dump("pressure_rate")},
      {"model.delay_spread", Dump("none")},
      {"model.delay_paths", Dump(1)},
      {"model.line_errors", Dump(RecordLoopSpec().line_errors)},
      {"model.harmonic_ratio", Dump(config.model.harmonic_ratio)},
      {"residuals.unreliable_weight", Dump(config.residuals.unreliable_weight)},
      {"solver.starts", Dump(config.solver.starts)},
      {"solver.max_iterations", Dump(config.solver.max_iterations)},
      {"family.members", Dump(config.family.members)},
      {"family.width", Dump(config.family.width)},
      {"family.test.gain_tolerance", Dump(config.family.test.gain_tolerance)},
      {"family.test.phase_tolerance_deg", Dump(config.family.test.phase_tolerance_deg)},
      {"family.test.loop_phase_tolerance_deg", Dump(config.family.test.loop_phase_tolerance_deg)},
      {"family.test.loop_gain_min", Dump(config.family.test.loop_gain_min)},
      {"family.test.second_crossing_tolerance_deg",
       Dump(config.family.test.second_crossing_tolerance_deg)},
      {"family.test.omega_spread_max", Dump(config.family.test.omega_spread_max)},
      {"family.test.xi_max", Dump(config.family.test.xi_max)},
      {"family.test.xi_increasing", Dump(config.family.test.xi_increasing)},
      {"family.test.transfer_distance_max", Dump(config.family.test.transfer_distance_max)},
      {"family.test.second_mode_share_max", Dump(config.family.test.second_mode_share_max)},
      {"family.test.second_crossing_gain_min", Dump(config.family.test.second_crossing_gain_min)},
      {"family.draw", Dump(config.family.draw == MemberDraw::kSpread ? "spread" : "uniform")},
      {"simulate.flame_shape", Dump(std::string(FlameShapeName(config.simulation.flame_shape)))},
      {"simulate.flame_table", Dump(config.simulation.flame_table)},
      {"simulate.saturation", Dump(config.simulation.saturation)},
      {"simulate.start", Dump(std::string(SimulationStartName(config.simulation.start)))},
      {"simulate.noise[].damping", Dump(kDefaultNoiseDamping)},
      {"simulate.sweep.one_way_s", Dump(SweepSpec().one_way_s)},
      {"simulate.sweep.steps", Dump(SweepSpec().steps)},
      {"simulate.combustion_noise_relative", Dump(config.simulation.combustion_noise_relative)},
      {"simulate.sensor_noise_relative", Dump(config.simulation.sensor_noise_relative)},
      {"simulate.loop_gain_min", Dump(config.simulation.loop_gain_min)},
      {"experiments[].record.skip_rows", Dump(RecordSpec().dialect.skip_rows)},
      {"experiments[].record.decimal", Dump(RecordSpec().dialect.decimal_comma ? "," : ".")},
      {"analysis.method", Dump(std::string(AnalysisMethodName(config.analysis.method)))},
  };
  for (const ParameterKind kind : kParameterKinds) {
    const ParameterSpec& spec = config.model[kind];
    const std::string key = "parameters." + std::string(ParameterName(kind));
    defaults[key + ".scope"] =
        Dump(spec.scope == ParameterScope::kShared ? "shared" : "experiment");
    // None of its own where a parameter has a dimension: the data suggest it.
    if (spec.min > 0.0) defaults[key + ".min"] = Dump(spec.min);
    if (std::isfinite(spec.max)) defaults[key + ".max"] = Dump(spec.max);
    defaults[key + ".fixed"] = Dump(spec.fixed);
  }
  for (const ResidualKind kind : kResidualKinds) {
    const ResidualSpec& spec = config.residuals[kind];
    const std::string key = "residuals." + std::string(ResidualName(kind));
    EXPECT_EQ(spec.loss, LossKind::kNone);
    EXPECT_EQ(spec.form, EquationForm::kAuto);
    defaults[key + ".enabled"] = Dump(spec.enabled);
    const ResidualDefinition& definition = DefinitionOf(kind);
    defaults[JoinKey(key, std::string(definition.std.key))] = Dump(spec.std);
    defaults[key + ".weight"] = Dump(spec.weight);
    defaults[key + ".loss"] = Dump("none");
    defaults[key + ".loss_scale"] = Dump(spec.loss_scale);
    if (!definition.center.key.empty()) {
      defaults[JoinKey(key, std::string(definition.center.key))] = Dump(spec.center);
    }
    if (definition.has_form) defaults[key + ".form"] = Dump("auto");
  }
  return defaults;
}

void CollectDefaults(const Json& schema, const std::string& path, Defaults& defaults) {
  if (schema.contains("default")) defaults[path] = schema["default"].dump();
  if (schema.contains("items")) {
    CollectDefaults(ResolveRef(ConfigSchema(), schema["items"]), path + "[]", defaults);
  }
  if (!schema.contains("properties")) return;
  for (const auto& [key, part] : schema["properties"].items()) {
    CollectDefaults(ResolveRef(ConfigSchema(), part), JoinKey(path, key), defaults);
  }
}

TEST(ConfigSchema, DefaultsAreThoseOfTheStructs) {
  Defaults in_schema;
  CollectDefaults(ConfigSchema(), "", in_schema);
  const Defaults in_structs = StructDefaults();
  for (const auto& [key, value] : in_structs) {
    ASSERT_TRUE(in_schema.contains(key)) << key << " has no default in the schema";
    EXPECT_EQ(in_schema[key], value) << key;
  }
  for (const auto& [key, value] : in_schema) {
    EXPECT_TRUE(in_structs.contains(key)) << key << " is not checked";
  }
}

// Every key has a description and refuses keys that it does not know.
void CheckDocumented(const Json& schema, const std::string& path) {
  ASSERT_TRUE(schema.contains("description")) << path;
  EXPECT_TRUE(schema.contains("type")) << path;
  EXPECT_LE(schema["description"].get_ref<const std::string&>().size(), 100u) << path;
  if (schema.contains("items")) {
    CheckDocumented(ResolveRef(ConfigSchema(), schema["items"]), path + "[]");
  }
  if (!schema.contains("properties")) return;
  ASSERT_TRUE(schema.contains("additionalProperties")) << path;
  if (schema["additionalProperties"].is_object()) {
    // Names of the user's own, all of one kind.
    CheckDocumented(ResolveRef(ConfigSchema(), schema["additionalProperties"]), path + ".*");
  } else {
    EXPECT_EQ(schema["additionalProperties"], false) << path;
  }
  for (const auto& [key, part] : schema["properties"].items()) {
    CheckDocumented(ResolveRef(ConfigSchema(), part), JoinKey(path, key));
  }
}

TEST(ConfigSchema, EveryKeyIsDocumented) { CheckDocumented(ConfigSchema(), ""); }

TEST(ConfigSchema, FlameShapesAreThoseOfTheModel) {
  Json shapes = Json::array();
  for (const FlameShape shape : kStatedFlameShapes) shapes.push_back(FlameShapeName(shape));
  EXPECT_EQ(ConfigSchema()["properties"]["simulate"]["properties"]["flame_shape"]["enum"], shapes);
}

// Every residual of the registry is read from the keys that it names.
TEST(ConfigResiduals, EachIsReadFromTheKeysOfItsDefinition) {
  const std::string experiments =
      "experiments: [{name: a, phi: 0.5, frequency_hz: 220, phase_deg: -5, gain: 12}]\n";
  for (const ResidualKind kind : kResidualKinds) {
    const ResidualDefinition& definition = DefinitionOf(kind);
    const std::string name(ResidualName(kind));
    std::string keys = std::string(definition.std.key) + ": 0.375, weight: 2.5, loss: huber";
    if (!definition.center.key.empty())
      keys += ", " + std::string(definition.center.key) + ": 0.75";
    const ConfigFile file(experiments + ("residuals: {" + name + ": {" + keys + "}}\n"));
    const ResidualSet set = LoadConfig(file.Path()).residuals;
    EXPECT_EQ(set[kind].std, 0.375) << name;
    EXPECT_EQ(set[kind].weight, 2.5) << name;
    EXPECT_EQ(set[kind].loss, LossKind::kHuber) << name;
    if (!definition.center.key.empty()) {
      EXPECT_EQ(set[kind].center, 0.75) << name;
    }
    const ConfigFile off(experiments + ("residuals: {" + name + ": off}\n"));
    EXPECT_FALSE(LoadConfig(off.Path()).residuals[kind].enabled) << name;
  }
}

TEST(ConfigSchema, OperatingParameterReplacesPhi) {
  const Json schema = ConfigSchemaFor("air_slpm");
  const Json& experiment = schema["definitions"]["experiment"];
  EXPECT_TRUE(experiment["properties"].contains("air_slpm"));
  EXPECT_FALSE(experiment["properties"].contains("phi"));
  EXPECT_EQ(experiment["required"], Json({"name", "air_slpm"}));
  EXPECT_EQ(ConfigSchemaFor("phi"), ConfigSchema());
}

TEST(NearestKey, FindsSlipsUnitsAndShortForms) {
  const std::vector<std::string> keys = {
      "frequency_hz", "frequency_std_hz", "gain", "gain_std", "phase_deg", "tau_s", "xi", "N"};
  EXPECT_EQ(NearestKey("fequency_hz", keys), "frequency_hz");           // a letter lost
  EXPECT_EQ(NearestKey("frequencyy_hz", keys), "frequency_hz");         // a letter too many
  EXPECT_EQ(NearestKey("frequency_std_zh", keys), "frequency_std_hz");  // two exchanged
  EXPECT_EQ(NearestKey("gian", keys), "gain");
  EXPECT_EQ(NearestKey("phase_rad", keys), "phase_deg");
  EXPECT_EQ(NearestKey("tau_ms", keys), "tau_s");
  EXPECT_EQ(NearestKey("freq", keys), "frequency_hz");
  EXPECT_EQ(NearestKey("XI", keys), "xi");
  EXPECT_EQ(NearestKey("n", keys), "N");
  EXPECT_EQ(NearestKey("colour", keys), std::nullopt);
  EXPECT_EQ(NearestKey("", keys), std::nullopt);
  EXPECT_EQ(NearestKey(std::string(100000, 'x'), keys), std::nullopt);
}

TEST(NearestKey, OfCandidatesThatShareAStemTheFewestEditsWin) {
  EXPECT_EQ(NearestKey("limit_cycle_phas", {"limit_cycle_gain", "limit_cycle_phase"}),
            "limit_cycle_phase");
  EXPECT_EQ(NearestKey("rel_spam", {"rel", "rel_span"}), "rel_span");
  EXPECT_EQ(NearestKey("gain_prio", {"gain_equality", "gain_prior"}), "gain_prior");
}

}  // namespace
}  // namespace howl::config_defaults_test
