#include "io/config/yaml/yaml_unclosed.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace howl {
namespace {

// The position behind the quoted scalar that starts at `begin`; npos when it does not end.
std::size_t EndOfQuoted(const std::string& text, std::size_t begin) {
  const char quote = text[begin];
  for (std::size_t i = begin + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      const bool is_doubled = quote == '\'' && i + 1 < text.size() && text[i + 1] == quote;
      if (!is_doubled) return i + 1;
      ++i;
    }
  }
  return std::string::npos;
}

bool IsOneOf(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }

}  // namespace

std::optional<Unclosed> FindUnclosedBracket(const std::string& text) {
  std::vector<Unclosed> open;
  int line = 1;
  char last = '\n';  // the last character that is not a blank
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    // A value starts behind these; elsewhere a bracket or quote is a part of plain text.
    const bool starts_value = IsOneOf(last, "\n:-,?[{");
    if (c == '#' && (i == 0 || IsOneOf(text[i - 1], " \t\n"))) {
      i = text.find('\n', i);
      if (i == std::string::npos) break;
      --i;
      continue;
    }
    if (IsOneOf(c, "\"'") && starts_value) {
      const std::size_t end = EndOfQuoted(text, i);
      if (end == std::string::npos) break;
      for (std::size_t j = i; j < end; ++j) line += text[j] == '\n' ? 1 : 0;
      i = end - 1;
      last = c;
      continue;
    }
    if (IsOneOf(c, "{[") && (starts_value || !open.empty())) {
      open.push_back({line, c});
    } else if (IsOneOf(c, "}]") && !open.empty()) {
      if (open.back().opening != (c == '}' ? '{' : '[')) return open.back();
      open.pop_back();
    }
    if (c == '\n') ++line;
    if (!IsOneOf(c, " \t\r")) last = c;
  }
  // Of several unclosed characters the outermost is named, because the others are inside it.
  if (open.empty()) return std::nullopt;
  return open.front();
}

bool IsUnclosedQuote(const std::string& text, int line, int column) {
  std::size_t begin = 0;
  for (int i = 0; i < line; ++i) {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return false;
    ++begin;
  }
  begin += static_cast<std::size_t>(column);
  if (begin >= text.size() || !IsOneOf(text[begin], "\"'")) return false;
  return EndOfQuoted(text, begin) == std::string::npos;
}

}  // namespace howl
