#include "io/config/schema/config_schema.h"

#include <glog/logging.h>

#include <nlohmann/json.hpp>

#include "config_schema.inc"  // kConfigSchemaText
#include "estimation/residuals/registry.h"

namespace howl {
namespace {

nlohmann::json Ref(const std::string& definition) {
  return {{"$ref", "#/definitions/" + definition}};
}

nlohmann::json NumberSchema(const ResidualNumber& number) {
  return {{"description", number.text},
          {"type", "number"},
          {"exclusiveMinimum", 0},
          {"default", number.value}};
}

nlohmann::json ResidualSchema(const ResidualDefinition& residual) {
  nlohmann::json keys = {
      {"enabled", Ref("enabled")},       {residual.std.key, NumberSchema(residual.std)},
      {"weight", Ref("weight")},         {"loss", Ref("loss")},
      {"loss_scale", Ref("loss_scale")}, {"experiments", Ref("names")}};
  if (!residual.center.key.empty()) keys[residual.center.key] = NumberSchema(residual.center);
  if (residual.has_form) keys["form"] = Ref("form");
  return {{"description",
           std::string(residual.text) + ", " + std::string(residual.equation) + "; false: off"},
          {"type", {"object", "boolean"}},
          {"additionalProperties", false},
          {"properties", std::move(keys)}};
}

nlohmann::json CompleteSchema() {
  nlohmann::json schema = nlohmann::json::parse(kConfigSchemaText);
  nlohmann::json& residuals = schema["properties"]["residuals"]["properties"];
  for (const ResidualKind kind : kResidualKinds) {
    residuals[std::string(ResidualName(kind))] = ResidualSchema(DefinitionOf(kind));
  }
  return schema;
}

}  // namespace

const nlohmann::json& ConfigSchema() {
  static const nlohmann::json schema = CompleteSchema();
  return schema;
}

nlohmann::json ConfigSchemaFor(const std::string& operating_parameter,
                               const std::vector<std::string>& experiments) {
  nlohmann::json schema = ConfigSchema();
  nlohmann::json& parameters = schema["properties"]["parameters"]["properties"];
  const nlohmann::json common = parameters;
  for (const std::string& name : experiments) {
    for (const auto& [key, parameter] : common.items()) {
      nlohmann::json& own = parameters[name + "." + key] = parameter;
      own["description"] = "the same for experiment " + name + " alone";
      own["properties"].erase("scope");
    }
  }
  if (operating_parameter == "phi") return schema;
  nlohmann::json& experiment = schema["definitions"]["experiment"];
  nlohmann::json& properties = experiment["properties"];
  properties[operating_parameter] = properties["phi"];
  properties.erase("phi");
  experiment["x-unknown-key"] =
      "operating_parameter puts " + operating_parameter + " in the place of phi";
  for (nlohmann::json& key : experiment["required"]) {
    if (key == "phi") key = operating_parameter;
  }
  return schema;
}

const nlohmann::json& ResolveRef(const nlohmann::json& root, const nlohmann::json& schema) {
  const auto ref = schema.find("$ref");
  if (ref == schema.end()) return schema;
  const std::string target = ref->get<std::string>();
  CHECK(target.starts_with("#")) << target;
  return root.at(nlohmann::json::json_pointer(target.substr(1)));
}

const nlohmann::json* FindMemberSchema(const nlohmann::json& root, const nlohmann::json& schema,
                                       const std::string& key) {
  const auto properties = schema.find("properties");
  if (properties != schema.end() && properties->contains(key))
    return &ResolveRef(root, properties->at(key));
  const auto any = schema.find("additionalProperties");
  return any != schema.end() && any->is_object() ? &ResolveRef(root, *any) : nullptr;
}

}  // namespace howl
