#include "io/config/config_schema.h"

#include <glog/logging.h>

#include <nlohmann/json.hpp>

#include "config_schema.inc"  // kConfigSchemaText

namespace howl {

const nlohmann::json& ConfigSchema() {
  static const nlohmann::json schema = nlohmann::json::parse(kConfigSchemaText);
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
  if (properties == schema.end()) return nullptr;
  if (properties->contains(key)) return &ResolveRef(root, properties->at(key));
  const auto any = schema.find("additionalProperties");
  return any != schema.end() && any->is_object() ? &ResolveRef(root, *any) : nullptr;
}

}  // namespace howl
