#include "io/records/record_faults.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

#include "io/records/open_table.h"
#include "io/records/records.h"

namespace howl {
namespace {

constexpr std::size_t kShownPlaces = 3;

class Faults {
 public:
  Faults(const RecordSpec& spec, const std::string& config_file, int config_line)
      : spec_(spec), config_file_(config_file), config_line_(config_line) {}

  RecordReading Read() {
    RecordReading reading;
    Try([&] { reading.record = LoadRecord(spec_, config_file_, config_line_); });
    if (!reading.record) {
      std::vector<ColumnName> columns = {spec_.pressure};
      if (spec_.heat_release) columns.push_back(*spec_.heat_release);
      for (const ColumnName& column : columns) TryAlone(column);
      if (spec_.time) TryTime();
      if (spec_.time) columns.push_back(*spec_.time);
      for (const ColumnName& column : columns) CountNoNumbers(column);
    }
    reading.faults = std::move(faults_);
    return reading;
  }

 private:
  void Try(const std::function<void()>& read) {
    try {
      read();
    } catch (const UserError& error) {
      if (told_.insert(error.what()).second) faults_.push_back(error);
    }
  }

  // Each column is read as the pressure of a record without time, which shows its samples' faults.
  void TryAlone(const ColumnName& column) {
    RecordSpec alone = spec_;
    alone.pressure = column;
    if (spec_.heat_release == column) alone.pressure_scale = spec_.heat_release_scale;
    alone.heat_release.reset();
    alone.ForgetInstruments();
    alone.time.reset();
    alone.time_unit_s.reset();
    alone.start_s = 0.0;
    alone.duration_s.reset();
    if (!alone.sampling_hz) alone.sampling_hz = 1.0;
    Try([&] { LoadRecord(alone, config_file_, config_line_); });
  }

  // The times need another column with them, which may be any that can be read.
  void TryTime() {
    RecordSpec timed = spec_;
    timed.heat_release.reset();
    timed.heat_release_response.reset();
    timed.delay_s = timed.pressure_in_heat_release = 0.0;
    Try([&] { LoadRecord(timed, config_file_, config_line_); });
  }

  void CountNoNumbers(const ColumnName& column) {
    Try([&] {
      const std::unique_ptr<TableSource> table = OpenTable(spec_.file, spec_.dialect);
      const std::vector<double> values = table->Read({column}).front();
      // Runs of rows, each from its first to its last.
      std::vector<std::pair<std::size_t, std::size_t>> runs;
      std::size_t count = 0;
      for (std::size_t row = 0; row < values.size(); ++row) {
        if (std::isfinite(values[row])) continue;
        ++count;
        if (!runs.empty() && runs.back().second + 1 == row) {
          runs.back().second = row;
        } else {
          runs.emplace_back(row, row);
        }
      }
      if (count < 2) return;  // the one is told already
      const bool has_lines = table->LineOf(0) > 0;
      const auto place = [&](std::size_t row) {
        return std::to_string(has_lines ? static_cast<std::size_t>(table->LineOf(row)) : row + 1);
      };
      std::string where;
      for (std::size_t i = 0; i < std::min(kShownPlaces, runs.size()); ++i) {
        const auto& [first, last] = runs[i];
        where += (i > 0 ? ", " : "") + place(first) + (last > first ? " to " + place(last) : "");
      }
      if (runs.size() > kShownPlaces) {
        where += " and " + std::to_string(runs.size() - kShownPlaces) + " more places";
      }
      throw UserError(spec_.file.string(), 0, DisplayName(column),
                      "no number in " + std::to_string(count) + " of " +
                          std::to_string(values.size()) + " samples (" +
                          (has_lines ? "lines " : "samples ") + where +
                          "), expected start_s and duration_s of a part without them");
    });
  }

  const RecordSpec& spec_;
  const std::string& config_file_;
  int config_line_;
  std::set<std::string> told_;
  std::vector<UserError> faults_;
};

}  // namespace

RecordReading ReadRecordOn(const RecordSpec& spec, const std::string& config_file,
                           int config_line) {
  return Faults(spec, config_file, config_line).Read();
}

}  // namespace howl
