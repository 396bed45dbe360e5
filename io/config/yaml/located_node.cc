#include "io/config/yaml/located_node.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace howl {
namespace {

bool IsOneOf(std::string_view text, std::initializer_list<std::string_view> words) {
  for (const std::string_view word : words) {
    if (text == word) return true;
  }
  return false;
}

bool IsBoolean(std::string_view text, bool& value) {
  value = IsOneOf(text, {"true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON"});
  return value || IsOneOf(text, {"false", "False", "FALSE", "no", "No", "NO", "off", "Off", "OFF"});
}

// Signs, digits, a point and an exponent: what from_chars takes beyond that ("nan", "1p3") is text.
bool IsNumber(std::string_view text, double& value, bool& is_integer) {
  std::string_view digits = text;
  const bool negative = digits.starts_with('-');
  if (negative || digits.starts_with('+')) digits.remove_prefix(1);
  if (IsOneOf(digits, {".inf", ".Inf", ".INF"})) {
    value = (negative ? -1.0 : 1.0) * std::numeric_limits<double>::infinity();
    is_integer = false;
    return true;
  }
  if (IsOneOf(text, {".nan", ".NaN", ".NAN"})) {
    value = std::numeric_limits<double>::quiet_NaN();
    is_integer = false;
    return true;
  }
  if (digits.empty() || !(digits[0] == '.' || (digits[0] >= '0' && digits[0] <= '9'))) return false;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return false;
  // A whole number in any notation (1e3 too); beyond 2^53 doubles are no longer one apart.
  is_integer = value == std::floor(value) && value < 9007199254740992.0;
  if (error == std::errc::result_out_of_range) {
    const std::size_t exponent = digits.find_first_of("eE");
    const bool is_tiny =
        exponent != std::string_view::npos && digits.substr(exponent + 1).starts_with('-');
    value = is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
    is_integer = false;
  }
  if (negative) value = -value;
  return true;
}

}  // namespace

const LocatedMember* LocatedNode::Find(std::string_view key) const {
  for (const LocatedMember& member : members) {
    if (member.key == key) return &member;
  }
  return nullptr;
}

std::size_t LocatedNode::CountNodes() const {
  std::size_t count = 1;
  for (const LocatedNode& item : items) count += item.CountNodes();
  for (const LocatedMember& member : members) count += member.value.CountNodes();
  return count;
}

std::size_t LocatedNode::CountText() const {
  std::size_t bytes = text.size();
  for (const LocatedNode& item : items) bytes += item.CountText();
  for (const LocatedMember& member : members) bytes += member.key.size() + member.value.CountText();
  return bytes;
}

LocatedNode MakeScalar(const std::string& text, bool quoted, int line) {
  LocatedNode node;
  node.line = line;
  node.text = text;
  node.quoted = quoted;
  node.kind = LocatedNode::Kind::kText;
  if (quoted) return node;
  bool is_integer = false;
  if (IsBoolean(text, node.boolean)) {
    node.kind = LocatedNode::Kind::kBoolean;
  } else if (IsNumber(text, node.number, is_integer)) {
    node.kind = is_integer ? LocatedNode::Kind::kInteger : LocatedNode::Kind::kNumber;
  }
  return node;
}

nlohmann::json ToJson(const LocatedNode& node) {
  switch (node.kind) {
    case LocatedNode::Kind::kNull:
      return nullptr;
    case LocatedNode::Kind::kBoolean:
      return node.boolean;
    case LocatedNode::Kind::kInteger:
      return static_cast<std::int64_t>(node.number);
    case LocatedNode::Kind::kNumber:
      if (std::isfinite(node.number)) return node.number;
      return node.text;
    case LocatedNode::Kind::kText:
      return node.text;
    case LocatedNode::Kind::kList: {
      nlohmann::json list = nlohmann::json::array();
      for (const LocatedNode& item : node.items) list.push_back(ToJson(item));
      return list;
    }
    case LocatedNode::Kind::kMapping: {
      nlohmann::json mapping = nlohmann::json::object();
      for (const LocatedMember& member : node.members) mapping[member.key] = ToJson(member.value);
      return mapping;
    }
  }
  return nullptr;
}

std::string JoinKey(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

}  // namespace howl
