#include "io/config/yaml/config_table.h"

#include <cctype>
#include <charconv>
#include <filesystem>
#include <vector>

namespace howl {
namespace {

// A config's first lines are never this many rows of numbers.
constexpr std::size_t kRows = 3;
constexpr std::size_t kMostHeaderLines = 5;

using Cells = std::vector<std::string_view>;

std::string_view Trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Splits a line at commas and semicolons, or at white space where it has neither.
Cells CellsOf(std::string_view line) {
  line = Trimmed(line);
  const bool has_marks = line.find_first_of(",;") != line.npos;
  const char* const separators = has_marks ? ",;" : " \t";
  Cells cells;
  while (!line.empty()) {
    const std::size_t end = line.find_first_of(separators);
    const std::string_view cell = Trimmed(line.substr(0, end));
    if (has_marks || !cell.empty()) cells.push_back(cell);
    if (end == line.npos) break;
    line.remove_prefix(end + 1);
  }
  return cells;
}

bool IsNumber(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return !cell.empty() && error != std::errc::invalid_argument && end == cell.data() + cell.size();
}

bool AreNumbers(const Cells& cells) {
  for (const std::string_view cell : cells) {
    if (!IsNumber(cell)) return false;
  }
  return !cells.empty();
}

// Finds the line before the numbers, if there is one; false where there are no rows of numbers.
bool FindHeader(std::string_view text, Cells& header, std::size_t& columns) {
  std::size_t rows = 0;
  for (std::size_t line = 0; line < kMostHeaderLines + kRows && !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    const Cells cells = CellsOf(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    if (AreNumbers(cells)) {
      if (rows > 0 && cells.size() != columns) return false;
      columns = cells.size();
      if (++rows == kRows) return true;
    } else {
      if (rows > 0) return false;
      header = cells;
    }
  }
  return false;
}

bool IsTime(std::string_view name) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  return name == "t" || name == "T" || name.starts_with("time") || name.starts_with("Time") ||
         (name.starts_with("t") && name.size() > 1 && !is_letter(name[1]));
}

std::string Example(const std::string& file, const Cells& names, std::size_t columns) {
  std::vector<std::string> signals;
  for (std::size_t i = 0; i < columns && signals.size() < 2; ++i) {
    const bool named = names.size() == columns && !names[i].empty();
    if (named && IsTime(names[i])) continue;
    signals.push_back(named ? std::string(names[i]) : std::to_string(i + 1));
  }
  const std::filesystem::path path(file);
  std::string record = "{file: " + path.filename().string();
  if (!signals.empty()) record += ", pressure: " + signals[0];
  if (signals.size() > 1) record += ", heat_release: " + signals[1];
  return "`experiments: [{name: " + path.stem().string() + ", phi: 0.5, record: " + record +
         ", sampling_hz: 5000}}]`";
}

}  // namespace

std::string DescribeRecordAsConfig(const std::string& file, std::string_view text) {
  std::string is;
  Cells names;
  std::size_t columns = 0;
  if (text.starts_with("\x89HDF")) is = "an HDF5 file";
  if (text.starts_with("MATLAB ")) is = "a MATLAB file";
  if (text.starts_with("\x1f\x8b")) is = "a gzip file";
  if (is.empty()) {
    if (!FindHeader(text, names, columns)) return "";
    is = "a table of numbers";
  }
  return "this is " + is +
         ", not a config, expected a YAML file that names it, with a line such as " +
         Example(file, names, columns);
}

}  // namespace howl
