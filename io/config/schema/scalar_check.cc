#include "io/config/schema/scalar_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "io/config/schema/schema_words.h"
#include "io/config/yaml/config_text.h"
#include "io/number_range.h"
#include "io/user_error.h"

namespace howl {
namespace {

// "1e-400" is read as zero, which it is not.
bool IsTooSmallForADouble(const LocatedNode& node) {
  if (node.number != 0.0) return false;
  const std::string_view digits(node.text.data(),
                                std::min(node.text.find_first_of("eE"), node.text.size()));
  return digits.find_first_of("123456789") != std::string_view::npos;
}

void CheckNumber(const std::string& file, const LocatedNode& node, const std::string& key,
                 std::vector<UserError>& mistakes) {
  if (!std::isfinite(node.number)) return;  // .inf, where the schema takes it
  if (IsCarried(node.number) && !IsTooSmallForADouble(node)) return;
  mistakes.emplace_back(file, node.line, key,
                        DescribeValue(node) +
                            " is out of range, expected 0 or a number of magnitude " +
                            kMagnitudeWords);
}

void CheckText(const std::string& file, int line, const std::string& key, const std::string& text,
               std::vector<UserError>& mistakes) {
  const std::size_t at = FindNoText(text);
  if (at == std::string::npos) return;
  std::array<char, 8> code{};
  std::snprintf(code.data(), code.size(), "0x%02x",
                static_cast<unsigned>(static_cast<unsigned char>(text[at])));
  mistakes.emplace_back(file, line, key,
                        "byte " + std::string(code.data()) + " at character " +
                            std::to_string(at + 1) +
                            " is not text, expected letters, digits and signs alone");
}

void Check(const std::string& file, const LocatedNode& node, const std::string& key,
           std::vector<UserError>& mistakes) {
  switch (node.kind) {
    case LocatedNode::Kind::kInteger:
    case LocatedNode::Kind::kNumber:
      return CheckNumber(file, node, key, mistakes);
    case LocatedNode::Kind::kText:
      return CheckText(file, node.line, key, node.text, mistakes);
    default:
      break;
  }
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    Check(file, node.items[i], key + "[" + std::to_string(i) + "]", mistakes);
  }
  for (const LocatedMember& member : node.members) {
    const std::string inner = JoinKey(key, member.key);
    CheckText(file, member.key_line, inner, member.key, mistakes);
    // The value at which an effect is absent may be as large as one likes.
    if (member.key == "null_value") continue;
    Check(file, member.value, inner, mistakes);
  }
}

}  // namespace

std::vector<UserError> FindScalarMistakes(const std::string& file, const LocatedNode& root) {
  std::vector<UserError> mistakes;
  Check(file, root, "", mistakes);
  return mistakes;
}

void CheckScalars(const std::string& file, const LocatedNode& root) {
  const std::vector<UserError> mistakes = FindScalarMistakes(file, root);
  if (!mistakes.empty()) throw mistakes.front();
}

}  // namespace howl
