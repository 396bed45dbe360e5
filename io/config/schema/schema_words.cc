#include "io/config/schema/schema_words.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "io/config/schema/config_schema.h"
#include "io/config/schema/nearest_key.h"

namespace howl {
namespace {

using Json = nlohmann::json;

std::string Number(const Json& value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value.get<double>());
  return text.data();
}

std::string Range(const Json& schema) {
  const bool has_min = schema.contains("minimum");
  const bool has_max = schema.contains("maximum");
  if (has_min && has_max) {
    return " from " + Number(schema["minimum"]) + " to " + Number(schema["maximum"]);
  }
  std::string text;
  if (schema.contains("exclusiveMinimum")) text += " above " + Number(schema["exclusiveMinimum"]);
  if (has_min) text += " of at least " + Number(schema["minimum"]);
  if (has_max)
    text += (text.empty() ? " of at most " : " and at most ") + Number(schema["maximum"]);
  return text;
}

void FindPlaces(const std::string& key, const Json& schema, const std::string& path,
                const Json& root, std::vector<std::string>& places) {
  if (schema.contains("items")) {
    FindPlaces(key, ResolveRef(root, schema["items"]), path + "[]", root, places);
  }
  if (!schema.contains("properties")) return;
  for (const auto& [name, part] : schema["properties"].items()) {
    if (name == key) places.push_back(path);
    FindPlaces(key, ResolveRef(root, part), JoinKey(path, name), root, places);
  }
}

}  // namespace

bool Accepts(const Json& schema, const std::string& type) {
  const Json& types = schema.at("type");
  return types.is_array() ? std::find(types.begin(), types.end(), type) != types.end()
                          : types == type;
}

std::string DescribeExpected(const Json& schema) {
  std::vector<std::string> kinds;
  if (schema.contains("enum")) {
    kinds.push_back("one of " + Join(schema["enum"].get<std::vector<std::string>>()));
  } else if (Accepts(schema, "string")) {
    kinds.push_back("text");
  }
  if (Accepts(schema, "integer")) kinds.push_back("a whole number" + Range(schema));
  if (Accepts(schema, "number")) kinds.push_back("a number" + Range(schema));
  if (Accepts(schema, "array"))
    kinds.push_back(schema.contains("minItems") ? "a list with at least one item" : "a list");
  if (Accepts(schema, "object")) kinds.push_back("a mapping (key: value)");
  if (Accepts(schema, "boolean")) kinds.push_back("true or false");
  if (Accepts(schema, "null")) kinds.push_back("null");
  std::string text;
  for (std::size_t i = 0; i < kinds.size(); ++i) text += (i == 0 ? "" : " or ") + kinds[i];
  const std::string description = schema.value("description", std::string());
  return description.empty() ? text : text + " (" + description + ")";
}

std::string DescribeValue(const LocatedNode& node) {
  constexpr std::size_t kLongest = 40;
  std::string text =
      node.text.size() > kLongest ? node.text.substr(0, kLongest) + "..." : node.text;
  switch (node.kind) {
    case LocatedNode::Kind::kNull:
      return "null";
    case LocatedNode::Kind::kText:
      return "\"" + text + "\"";
    case LocatedNode::Kind::kList:
      return "a list";
    case LocatedNode::Kind::kMapping:
      return "a mapping";
    default:
      return text;
  }
}

std::string DescribeChoice(const std::string& word, const std::vector<std::string>& choices) {
  std::string text = choices.size() == 1 ? choices[0] : "one of " + Join(choices);
  const auto nearest = NearestKey(word, choices);
  if (nearest && choices.size() > 1) text += "; the nearest is " + *nearest;
  return text;
}

std::string Join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::vector<std::string> KeysOf(const Json& schema) {
  auto keys = schema.value("required", std::vector<std::string>());
  const auto properties = schema.find("properties");
  if (properties == schema.end()) return keys;
  for (const auto& [name, part] : properties->items()) {
    if (std::find(keys.begin(), keys.end(), name) == keys.end()) keys.push_back(name);
  }
  return keys;
}

std::optional<std::string> OnlyPlaceOf(const std::string& key, const Json& root_schema) {
  std::vector<std::string> places;
  FindPlaces(key, root_schema, "", root_schema, places);
  if (places.size() != 1) return std::nullopt;
  return places[0].empty() ? "the top level" : places[0];
}

}  // namespace howl
