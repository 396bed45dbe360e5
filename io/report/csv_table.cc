#include "io/report/csv_table.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace howl {
namespace {

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

std::optional<std::size_t> CsvTable::Find(const std::string& column) const {
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::string CsvTable::Text(std::size_t row, const std::string& column) const {
  const auto index = Find(column);
  return index ? rows[row][*index] : std::string();
}

double CsvTable::Number(std::size_t row, const std::string& column) const {
  const std::string text = Text(row, column);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size() && !text.empty();
  return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

CsvTable ReadCsvTable(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("no such file");
  // A device may never end.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) throw std::runtime_error("no table");
  CsvTable table;
  std::string line;
  if (std::getline(file, line)) table.columns = Cells(line);
  while (std::getline(file, line)) {
    if (line.empty()) continue;
    table.rows.push_back(Cells(line));
    if (table.rows.back().size() != table.columns.size()) {
      throw std::runtime_error("line " + std::to_string(table.rows.size() + 1) + " has " +
                               std::to_string(table.rows.back().size()) + " cells, expected " +
                               std::to_string(table.columns.size()));
    }
  }
  if (table.rows.empty()) throw std::runtime_error("no rows");
  return table;
}

std::vector<std::string> DifferingColumns(const CsvTable& table) {
  std::vector<std::string> columns;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const bool differs = std::ranges::any_of(
        table.rows, [&](const auto& row) { return row[k] != table.rows.front()[k]; });
    if (k == 0 || differs) columns.push_back(table.columns[k]);
  }
  return columns;
}

}  // namespace howl
