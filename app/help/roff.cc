#include "app/help/roff.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>

namespace howl {
namespace {

// The letter of more than one byte that begins at text[*at]; *at moves behind it.
std::string Escaped(std::string_view text, std::size_t* at) {
  const auto first = static_cast<unsigned char>(text[*at]);
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  std::uint32_t letter = first & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes && *at + i < text.size(); ++i) {
    letter = (letter << 6U) | (static_cast<unsigned char>(text[*at + i]) & 0x3FU);
  }
  *at += bytes;
  char name[16];
  std::snprintf(name, sizeof name, "\\[u%04X]", letter);
  return name;
}

bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool IsWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

std::string Everywhere(std::string_view text, bool every_minus) {
  std::string roff;
  bool bold = false;
  const bool accents_pair = std::ranges::count(text, '`') % 2 == 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (static_cast<unsigned char>(c) >= 0x80) {
      roff += Escaped(text, &at);
      continue;
    }
    const char before = at == 0 ? ' ' : text[at - 1];
    const char after = at + 1 == text.size() ? ' ' : text[at + 1];
    ++at;
    if (c == '`' && accents_pair) {
      bold = !bold;
      roff += bold ? "\\fB" : "\\fR";
    } else if (c == '-') {
      roff += every_minus || IsDigit(after) || !IsWord(before) ? "\\-" : "-";
    } else if (c == '\\') {
      roff += "\\e";
    } else if (c == '^') {
      roff += "\\(ha";
    } else if (c == '~') {
      roff += "\\(ti";
    } else if ((c == '.' || c == '\'') && (before == '\n' || roff.empty())) {
      roff += std::string("\\&") + c;  // else the line would be a command
    } else {
      roff += c;
    }
  }
  return roff;
}

}  // namespace

std::string Roff(std::string_view utf8) { return Everywhere(utf8, false); }

std::string RoffBold(std::string_view word) { return "\\fB" + Everywhere(word, true) + "\\fR"; }

std::string RoffItalic(std::string_view word) { return "\\fI" + Everywhere(word, true) + "\\fR"; }

}  // namespace howl
