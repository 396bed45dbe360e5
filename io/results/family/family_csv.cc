#include "io/results/family/family_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "estimation/family/problem/membership.h"
#include "io/results/csv_writer.h"
#include "io/user_error.h"

namespace howl {
namespace {

constexpr const char* kHeader =
    "member,experiment,phi,omega_hz,xi,N,M,tau_s,loop_gain,gain_error,phase_error_deg,"
    "loop_phase_error_deg";
// The names of the numeric columns, which follow member and experiment.
constexpr std::size_t kOmegaColumn = 1;
constexpr std::size_t kXiColumn = 2;

std::vector<std::string> Split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (line.ends_with(',')) cells.emplace_back();
  return cells;
}

// The number that a whole cell is.
template <typename T>
std::optional<T> NumberIn(const std::string& cell) {
  T value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

double ParseCell(const std::string& cell, const std::filesystem::path& path, int line,
                 const std::string& column) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::optional<double> value = NumberIn<double>(cell);
  if (value) return *value;
  throw UserError(path.string(), line, column, "\"" + cell + "\", expected a number");
}

int ParseMember(const std::string& cell, const std::filesystem::path& path, int line) {
  const std::optional<int> member = NumberIn<int>(cell);
  if (member && *member >= 1) return *member;
  throw UserError(path.string(), line, "member",
                  "\"" + cell + "\", expected a whole number from 1 on");
}

void AddSummary(FamilyTable& table, std::size_t numbers) {
  for (std::vector<double>& row : table.rows) {
    double omega_min = std::numeric_limits<double>::infinity();
    double omega_max = 0.0;
    double xi_max = 0.0;
    for (std::size_t k = 3; k < row.size(); k += numbers) {
      omega_min = std::min(omega_min, row[k + kOmegaColumn]);
      omega_max = std::max(omega_max, row[k + kOmegaColumn]);
      xi_max = std::max(xi_max, row[k + kXiColumn]);
    }
    row[1] = omega_max / omega_min - 1.0;
    row[2] = xi_max;
  }
}

}  // namespace

std::string FamilyCsv(std::span<const Experiment> experiments,
                      std::span<const std::vector<LoopModel>> members,
                      std::string_view operating_parameter) {
  const OwnNameColumn own(operating_parameter);
  CsvWriter csv(kHeader + own.Header());
  for (std::size_t m = 0; m < members.size(); ++m) {
    for (std::size_t i = 0; i < experiments.size(); ++i) {
      const LoopModel& model = members[m][i];
      const ExperimentErrors errors = ComputeErrors(experiments[i], model);
      csv.Cell(std::to_string(m + 1)).Cell(experiments[i].name);
      for (const double value : {experiments[i].phi, model.omega_hz, model.xi, model.N, model.M,
                                 model.tau_s, errors.loop_gain, errors.gain_error,
                                 errors.phase_error_deg, errors.loop_phase_error_deg}) {
        csv.Cell(value);
      }
      own.Add(csv, experiments[i].phi).EndRow();
    }
  }
  return csv.Text();
}

std::size_t FamilyTable::Column(const std::string& name) const {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end()) throw std::out_of_range(name);
  return static_cast<std::size_t>(found - columns.begin());
}

FamilyTable ReadFamilyCsv(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::error_code ignored;
  if (!file || !std::filesystem::is_regular_file(path, ignored)) {  // a device may never end
    throw UserError(path.string(), 0, "", "no such file, expected the one that howl family writes");
  }
  std::string line;
  const bool is_family =
      std::getline(file, line) && (line + ",").starts_with(std::string(kHeader) + ",");
  if (!is_family) {
    throw UserError(path.string(), 1, "",
                    "not a family, expected the header " + std::string(kHeader));
  }
  const std::vector<std::string> header = Split(line);
  const std::vector<std::string> numbers(header.begin() + 2, header.end());
  FamilyTable table;
  table.columns = {"member", "omega_spread", "xi_max"};
  for (int number = 2; std::getline(file, line); ++number) {
    const std::vector<std::string> cells = Split(line);
    if (cells.size() != header.size()) {
      throw UserError(
          path.string(), number, "",
          std::to_string(cells.size()) + " columns, expected " + std::to_string(header.size()));
    }
    const double member = ParseMember(cells[0], path, number);
    if (table.rows.empty() || table.rows.back()[0] != member) {
      table.rows.push_back({member, 0.0, 0.0});
    }
    if (table.rows.size() == 1) {
      table.experiments.push_back(cells[1]);
      for (const std::string& column : numbers) {
        table.columns.push_back(cells[1] + "." + column);
      }
    }
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      table.rows.back().push_back(ParseCell(cells[k + 2], path, number, numbers[k]));
    }
  }
  for (const std::vector<double>& row : table.rows) {
    if (row.size() != table.columns.size()) {
      throw UserError(
          path.string(), 0, "member " + std::to_string(static_cast<int>(row[0])),
          "not a row for each experiment, expected " + std::to_string(table.experiments.size()));
    }
  }
  AddSummary(table, numbers.size());
  return table;
}

}  // namespace howl
