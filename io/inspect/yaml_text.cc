#include "io/inspect/yaml_text.h"

#include <cctype>
#include <sstream>

#include "io/config/yaml/config_text.h"
#include "io/config/yaml/located_node.h"

namespace howl {
namespace {

bool IsPlain(const std::string& text) {
  if (MakeScalar(text, false, 1).kind != LocatedNode::Kind::kText) return false;
  if (std::isalpha(static_cast<unsigned char>(text.front())) == 0) return false;
  if (text == "null" || text == "Null" || text == "NULL") return false;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 &&
        std::string_view("_-./").find(c) == std::string_view::npos) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::string YamlScalar(const std::string& text) {
  const LocatedNode::Kind kind = MakeScalar(text, false, 1).kind;
  if (kind == LocatedNode::Kind::kInteger || (!text.empty() && IsPlain(text))) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string YamlComment(const std::string& text, std::size_t indent, std::size_t columns) {
  std::string shown = text;
  for (std::size_t at = FindNoText(shown); at != std::string::npos; at = FindNoText(shown)) {
    shown[at] = '?';
  }
  const std::string start = "#" + std::string(indent + 1, ' ');
  std::istringstream words(shown);
  std::string lines;
  std::string line = start;
  bool is_empty = true;
  for (std::string word; words >> word;) {
    if (!is_empty && line.size() + 1 + word.size() > columns) {
      lines += line + "\n";
      line = start + "    ";
      is_empty = true;
    }
    line += (is_empty ? "" : " ") + word;
    is_empty = false;
  }
  return lines + line + "\n";
}

}  // namespace howl
