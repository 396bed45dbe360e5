// The data of a report's figures, as figures/NAME.csv has them.
#ifndef HOWL_TESTS_APP_REPORT_FIGURE_DATA_H_
#define HOWL_TESTS_APP_REPORT_FIGURE_DATA_H_

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace howl {

struct Row {
  std::string curve;
  std::vector<double> numbers;
};

// A figure's data: the curve's name, then numbers (NaN where a cell is none).
inline std::vector<Row> FigureData(const std::filesystem::path& folder, const std::string& name) {
  std::stringstream text(ReadFile(folder / "figures" / (name + ".csv")));
  std::vector<Row> rows;
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::stringstream cells(line);
    Row row;
    std::getline(cells, row.curve, ',');
    for (std::string cell; std::getline(cells, cell, ',');) {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      row.numbers.push_back(end == cell.c_str() ? NAN : value);
    }
    rows.push_back(row);
  }
  return rows;
}

// The points of one curve.
inline std::vector<Row> Curve(const std::vector<Row>& rows, const std::string& curve) {
  std::vector<Row> out;
  for (const Row& row : rows) {
    if (row.curve == curve) out.push_back(row);
  }
  return out;
}

}  // namespace howl

#endif  // HOWL_TESTS_APP_REPORT_FIGURE_DATA_H_
