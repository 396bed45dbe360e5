#include "io/config/schema/schema_explain.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "io/config/schema/config_schema.h"
#include "io/config/schema/nearest_key.h"
#include "io/config/schema/schema_words.h"

namespace howl {
namespace {

using Json = nlohmann::json;
using Kind = LocatedNode::Kind;

bool IsNumberWanted(const Json& schema) {
  return (Accepts(schema, "number") || Accepts(schema, "integer")) && !Accepts(schema, "string");
}

bool HasRightType(const LocatedNode& node, const Json& schema) {
  switch (node.kind) {
    case Kind::kNull:
      return Accepts(schema, "null");
    case Kind::kBoolean:
      return Accepts(schema, "boolean");
    case Kind::kInteger:
      return Accepts(schema, "integer") || Accepts(schema, "number");
    case Kind::kNumber:
      return Accepts(schema, std::isfinite(node.number) ? "number" : "string");
    case Kind::kText:
      return Accepts(schema, "string");
    case Kind::kList:
      return Accepts(schema, "array");
    case Kind::kMapping:
      return Accepts(schema, "object");
  }
  return false;
}

std::string ExplainTextForNumber(const LocatedNode& node, const Json& schema) {
  static const std::regex number(R"([-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)");
  static const std::regex with_unit(
      R"(([-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)\s*([^\d\s,.].{0,20}))");
  static const std::regex with_comma(R"([-+]?\d+,\d+)");
  static const std::regex not_finite(R"([-+]?\.?(nan|inf|infinity))", std::regex::icase);
  const std::string shown = DescribeValue(node);
  const std::string expected = ", expected " + DescribeExpected(schema);
  // No number is this long, and regular expressions need stack for each character.
  if (node.text.size() > 60) return shown + " is text" + expected;
  std::smatch match;
  if (std::regex_match(node.text, number)) {
    return shown + " is text because of its quotes" + expected + " without quotes";
  }
  if (std::regex_match(node.text, not_finite)) {
    return shown + " is not a finite number" + expected;
  }
  if (std::regex_match(node.text, with_comma)) {
    return shown + " has a comma" + expected + " with a decimal point";
  }
  if (std::regex_match(node.text, match, with_unit)) {
    return shown +
           " carries a unit, expected the number alone, as the key already says its unit: " +
           DescribeExpected(schema);
  }
  return shown + " is text" + expected;
}

std::string ExplainType(const LocatedNode& node, const Json& schema) {
  const std::string expected = ", expected " + DescribeExpected(schema);
  const std::string shown = DescribeValue(node);
  switch (node.kind) {
    case Kind::kNull:
      return "has no value" + expected;
    case Kind::kBoolean: {
      const bool takes_text = Accepts(schema, "string");
      return shown + " means " + (node.boolean ? "true" : "false") + expected +
             (takes_text ? "; in quotes it is text" : "");
    }
    case Kind::kInteger:
    case Kind::kNumber:
      if (!std::isfinite(node.number)) return shown + " is not a finite number" + expected;
      if (Accepts(schema, "integer")) {
        const bool is_whole = node.number == std::floor(node.number);
        return shown + (is_whole ? " is out of range" : " is not a whole number") + expected;
      }
      return shown + " is a number" + expected;
    case Kind::kText:
      if (IsNumberWanted(schema)) return ExplainTextForNumber(node, schema);
      return shown + " is text" + expected;
    case Kind::kList:
    case Kind::kMapping:
      break;
  }
  return "this is " + shown + expected;
}

bool IsInRange(double value, const Json& schema) {
  const auto limit = [&](const char* key, double none) { return schema.value(key, none); };
  return value >= limit("minimum", -HUGE_VAL) && value <= limit("maximum", HUGE_VAL) &&
         !(schema.contains("exclusiveMinimum") && value <= schema["exclusiveMinimum"]) &&
         !(schema.contains("exclusiveMaximum") && value >= schema["exclusiveMaximum"]);
}

std::optional<std::string> ExplainValue(const LocatedNode& node, const Json& schema) {
  const std::string expected = ", expected " + DescribeExpected(schema);
  const bool is_number = node.kind == Kind::kInteger || node.kind == Kind::kNumber;
  if (is_number && std::isfinite(node.number) && !IsInRange(node.number, schema)) {
    return DescribeValue(node) + " is out of range" + expected;
  }
  if (node.kind == Kind::kList && node.items.size() < schema.value("minItems", std::size_t{0})) {
    return "the list is empty" + expected;
  }
  if (node.kind != Kind::kText) return std::nullopt;
  if (node.text.size() < schema.value("minLength", std::size_t{0})) {
    return "the text is empty" + expected;
  }
  if (node.text.size() > schema.value("maxLength", node.text.size())) {
    return DescribeValue(node) + " has " + std::to_string(node.text.size()) +
           " characters, expected at most " + schema["maxLength"].dump();
  }
  if (schema.contains("enum")) {
    const auto choices = schema["enum"].get<std::vector<std::string>>();
    if (std::find(choices.begin(), choices.end(), node.text) == choices.end()) {
      return DescribeValue(node) + " is not known here, expected " +
             DescribeChoice(node.text, choices);
    }
  }
  if (schema.contains("pattern") &&
      !std::regex_search(node.text, std::regex(schema["pattern"].get<std::string>()))) {
    return DescribeValue(node) + " cannot be used" + expected;
  }
  return std::nullopt;
}

std::string ExplainUnknownKey(const std::string& key, const Json& schema, const Json& root_schema) {
  const std::vector<std::string> known = KeysOf(schema);
  if (!key.empty() && key.find_first_not_of("0123456789.") == std::string::npos) {
    return "a number stands where a key should be, expected a decimal point in place of a decimal "
           "comma, or one of " +
           Join(known);
  }
  if (const auto nearest = NearestKey(key, known)) {
    const std::string meaning =
        ResolveRef(root_schema, schema["properties"][*nearest]).value("description", std::string());
    return "is not a known key, expected the nearest one, " + *nearest + " (" + meaning + ")";
  }
  if (const auto place = OnlyPlaceOf(key, root_schema)) {
    return "is not a known key here, expected it under " + *place;
  }
  std::string text = "is not a known key, expected one of " + Join(known);
  if (schema.contains("x-unknown-key")) {
    text += "; " + schema["x-unknown-key"].get<std::string>();
  }
  return text;
}

}  // namespace

std::vector<SchemaMistake> ExplainMistakes(const LocatedNode& node, const std::string& key,
                                           const Json& schema, const Json& root_schema) {
  if (!HasRightType(node, schema)) return {{node.line, key, ExplainType(node, schema)}};
  if (const auto what = ExplainValue(node, schema)) return {{node.line, key, *what}};
  std::vector<SchemaMistake> mistakes;
  if (node.kind != Kind::kMapping) return mistakes;
  for (const LocatedMember& member : node.members) {
    if (FindMemberSchema(root_schema, schema, member.key) != nullptr) continue;
    mistakes.push_back({member.key_line, JoinKey(key, member.key),
                        ExplainUnknownKey(member.key, schema, root_schema)});
  }
  for (const Json& required : schema.value("required", Json::array())) {
    const auto name = required.get<std::string>();
    if (node.Find(name) != nullptr) continue;
    const Json& missing = ResolveRef(root_schema, schema["properties"][name]);
    mistakes.push_back(
        {node.line, JoinKey(key, name), "is missing, expected " + DescribeExpected(missing)});
  }
  return mistakes;
}

}  // namespace howl
