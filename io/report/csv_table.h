// A CSV file as other commands write it: a header, then rows of numbers and names.
#ifndef HOWL_IO_REPORT_CSV_TABLE_H_
#define HOWL_IO_REPORT_CSV_TABLE_H_

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace howl {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  std::optional<std::size_t> Find(const std::string& column) const;
  // Empty where the column is missing.
  std::string Text(std::size_t row, const std::string& column) const;
  // NaN where the cell is empty, missing or no number.
  double Number(std::size_t row, const std::string& column) const;
};

// Throws std::runtime_error saying what is wrong: no such file, no rows, a row of another length.
CsvTable ReadCsvTable(const std::filesystem::path& path);

// The first column, which names the rows, and those that do not have the same cell in all rows.
std::vector<std::string> DifferingColumns(const CsvTable& table);

}  // namespace howl

#endif  // HOWL_IO_REPORT_CSV_TABLE_H_
