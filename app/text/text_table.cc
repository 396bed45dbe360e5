#include "app/text/text_table.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace howl {
namespace {

constexpr std::size_t kGap = 2;

}  // namespace

std::string TextTable::Text() const {
  std::vector<std::size_t> widths;
  for (const auto& row : rows_) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t k = 0; k < row.size(); ++k) {
      widths[k] = std::max(widths[k], DisplayWidth(row[k]));
    }
  }
  std::string text;
  for (std::size_t next = 1; next < std::max<std::size_t>(widths.size(), 2);) {
    const std::size_t first = next;
    std::size_t width = widths.empty() ? 0 : widths[0];
    while (next < widths.size() &&
           (next == first || width + kGap + widths[next] <= kTerminalColumns)) {
      width += kGap + widths[next++];
    }
    if (first > 1) text += "\n";
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto& row = rows_[r];
      std::string line = row.empty() ? "" : row[0];
      line += std::string(row.empty() ? 0 : widths[0] - DisplayWidth(row[0]), ' ');
      for (std::size_t k = first; k < std::min(next, row.size()); ++k) {
        line += std::string(kGap + widths[k] - DisplayWidth(row[k]), ' ') + row[k];
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += (r == 0 ? Bold(line) : line) + "\n";
    }
    if (widths.size() < 2) break;
  }
  return text;
}

std::size_t DisplayWidth(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string Wrapped(const std::string& text, std::size_t indent) {
  std::string out;
  std::size_t column = 0;
  std::size_t at = 0;
  while (at < text.size()) {
    std::size_t end = text.find(' ', at + 1);
    if (end == std::string::npos) end = text.size();
    std::string word = text.substr(at, end - at);
    if (column + DisplayWidth(word) > kTerminalColumns && column > indent) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
      if (word.front() == ' ') word.erase(0, 1);
    }
    out += word;
    column += DisplayWidth(word);
    at = end;
  }
  return out;
}

std::string CommaSeparated(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string Bold(const std::string& text) {
  static const bool shown = isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
  return shown ? "\033[1m" + text + "\033[0m" : text;
}

std::string Significant(double value, int digits) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  const double size = std::abs(value);
  char buffer[64];
  if (size >= 1e-4 && size < 1e9) {
    const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
    std::snprintf(buffer, sizeof buffer, "%.*f", std::max(0, digits - before), value);
  } else {
    std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  }
  return buffer;
}

std::string Fixed(double value, int decimals) {
  if (std::isnan(value)) return "-";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  return buffer;
}

}  // namespace howl
