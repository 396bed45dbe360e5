#include "io/records/records.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "io/number_range.h"
#include "io/records/columns/number_text.h"
#include "io/records/columns/table_source.h"
#include "io/records/columns/time_column.h"
#include "io/records/columns/time_unit.h"
#include "io/records/file_state.h"
#include "io/records/known_instruments.h"
#include "io/records/open_table.h"
#include "io/user_error.h"

namespace howl {
namespace {

// Two rates whose relative difference is less are in the same unit; units differ by a thousand.
constexpr double kSameRate = 0.01;

const std::string kFewSamples = " samples, expected at least " + std::to_string(kFewestSamples);

struct Part {
  std::size_t first = 0;
  std::size_t count = 0;
};

class Loader {
 public:
  Loader(const RecordSpec& spec, const std::string& config_file, int config_line)
      : spec_(spec), config_file_(config_file), config_line_(config_line) {}

  Record Load();

 private:
  void CheckSpec() const;
  Part ChoosePart(std::size_t rows, double step_s) const;
  void CheckLength(const Part& part) const;
  double TimeUnit(double step) const;
  double CheckTime(std::span<const double> time, std::size_t first, double step, double resolution,
                   double unit_s) const;
  void Take(std::vector<double>& column, const ColumnName& name, Part part, double scale) const;

  [[noreturn]] void FailConfig(const std::string& key, const std::string& what) const {
    throw UserError(config_file_, config_line_, key, what);
  }
  [[noreturn]] void FailData(std::size_t row, const ColumnName& name,
                             const std::string& what) const {
    const int line = table_->LineOf(row);
    const std::string sample = line > 0 ? "" : "sample " + std::to_string(row + 1) + ": ";
    throw UserError(spec_.file.string(), line, name.empty() ? name : DisplayName(name),
                    sample + what);
  }

  const RecordSpec& spec_;
  const std::string& config_file_;
  int config_line_;
  std::unique_ptr<TableSource> table_;
};

void Loader::CheckSpec() const {
  const auto check = [&](bool good, const char* key, double value, const char* expected) {
    if (!good) FailConfig(key, NumberText(value) + ", expected " + expected);
  };
  const auto is_scale = [](double scale) { return std::isfinite(scale) && scale != 0.0; };
  check(is_scale(spec_.pressure_scale), "pressure_scale", spec_.pressure_scale,
        "a finite number other than 0");
  check(is_scale(spec_.heat_release_scale), "heat_release_scale", spec_.heat_release_scale,
        "a finite number other than 0");
  check(spec_.start_s >= 0.0 && std::isfinite(spec_.start_s), "start_s", spec_.start_s,
        "a time of 0 s or more");
  const double duration_s = spec_.duration_s.value_or(1.0);
  check(duration_s > 0.0 && std::isfinite(duration_s), "duration_s", duration_s,
        "a time above 0 s");
  const double sampling_hz = spec_.sampling_hz.value_or(1.0);
  check(sampling_hz > 0.0 && std::isfinite(sampling_hz), "sampling_hz", sampling_hz,
        "a rate above 0 Hz");
  if (!spec_.sampling_hz && !spec_.time) {
    FailConfig("sampling_hz", "missing, expected it or a time column");
  }
}

Part Loader::ChoosePart(std::size_t rows, double step_s) const {
  const double length_s = static_cast<double>(rows) * step_s;
  const auto samples = [&](double time_s) { return std::round(time_s / step_s); };
  const std::string length = "the record's " + NumberText(length_s, 6) + " s";
  if (samples(spec_.start_s) >= static_cast<double>(rows)) {
    FailConfig("start_s", NumberText(spec_.start_s) + " s, expected less than " + length);
  }
  Part part;
  part.first = static_cast<std::size_t>(samples(spec_.start_s));
  part.count = rows - part.first;
  if (!spec_.duration_s) return part;
  if (samples(*spec_.duration_s) > static_cast<double>(part.count)) {
    FailConfig("duration_s", NumberText(*spec_.duration_s) + " s from start_s " +
                                 NumberText(spec_.start_s) + " s, expected to end within " +
                                 length);
  }
  part.count = static_cast<std::size_t>(samples(*spec_.duration_s));
  return part;
}

void Loader::CheckLength(const Part& part) const {
  if (part.count >= kFewestSamples) return;
  FailConfig(spec_.duration_s ? "duration_s" : "start_s",
             "leaves " + std::to_string(part.count) + kFewSamples);
}

// Seconds in a unit of the times: as the config states it, else by the column's name, or by the
// rate that sampling_hz gives with them; else the times are in seconds.
double Loader::TimeUnit(double step) const {
  if (spec_.time_unit_s) return *spec_.time_unit_s;
  if (const auto unit_s = TimeUnitOfName(table_->NameOf(*spec_.time))) return *unit_s;
  if (!spec_.sampling_hz) return 1.0;
  return TimeUnitOfRates(1.0 / step, *spec_.sampling_hz, kSameRate).value_or(1.0);
}

// The rate in Hz; `first` is the row of time[0]. Times, step and resolution in units of unit_s.
double Loader::CheckTime(std::span<const double> time, std::size_t first, double step,
                         double resolution, double unit_s) const {
  const auto fault = FindTimeFault(time, step, resolution, unit_s);
  if (fault) FailData(first + fault->row, *spec_.time, fault->what);
  const double rate_hz = SamplingRateHz(time, resolution) * (1.0 / unit_s);
  if (!IsCarried(rate_hz)) {
    FailData(first, *spec_.time,
             "a sampling rate of " + NumberText(rate_hz, 6) + " Hz is out of range, expected one " +
                 kMagnitudeWords);
  }
  if (!spec_.sampling_hz) return rate_hz;
  const double span = time.back() - time.front();
  const double tolerance = kSamplingRateTolerance + resolution / span;
  if (std::abs(rate_hz / *spec_.sampling_hz - 1.0) > tolerance) {
    FailData(first, *spec_.time,
             "two sampling rates, " + NumberText(rate_hz, 6) + " Hz by the times in " +
                 std::string(UnitOfSeconds(unit_s)) + " and " + NumberText(*spec_.sampling_hz) +
                 " Hz by sampling_hz (" + config_file_ + ":" + std::to_string(config_line_) +
                 "), expected one");
  }
  return *spec_.sampling_hz;
}

void Loader::Take(std::vector<double>& column, const ColumnName& name, Part part,
                  double scale) const {
  double least = column[part.first];
  double most = least;
  for (std::size_t i = 0; i < part.count; ++i) {
    const double value = column[part.first + i];
    if (!std::isfinite(value * scale)) {
      FailData(part.first + i, name,
               NumberText(value) + (std::isfinite(value) ? " times its scale" : "") +
                   ", expected a finite number");
    }
    if (std::abs(value * scale) > kMostMagnitude) {
      FailData(part.first + i, name,
               NumberText(value) + (scale == 1.0 ? "" : " times its scale") +
                   " is out of range, expected a number of magnitude up to 1e30");
    }
    least = std::min(least, value);
    most = std::max(most, value);
    column[i] = value * scale;
  }
  if (least == most) {
    FailData(part.first, name,
             "constant at " + NumberText(least) + " in all " + std::to_string(part.count) +
                 " samples, expected a signal");
  }
  if (!((most - least) * std::abs(scale) >= kLeastMagnitude)) {
    FailData(part.first, name,
             "from " + NumberText(least) + " to " + NumberText(most) +
                 (scale == 1.0 ? "" : " times its scale") +
                 ", expected a signal that moves by 1e-30 or more: a larger scale");
  }
  // Shrunk in place where that frees much: a copy of a long record would double its memory.
  column.resize(part.count);
  if (2 * part.count < part.first + part.count) column.shrink_to_fit();
}

Record Loader::Load() {
  CheckSpec();
  const FileState before(spec_.file);
  table_ = OpenTable(spec_.file, spec_.dialect);
  std::vector<ColumnName> names = {spec_.pressure};
  if (spec_.heat_release) names.push_back(*spec_.heat_release);
  if (spec_.time) names.push_back(*spec_.time);
  Columns columns;
  try {
    columns = table_->Read(names);
  } catch (const std::bad_alloc&) {
    throw UserError(spec_.file.string(), 0, "",
                    "does not fit into the memory, expected a shorter record");
  }
  // Cut short or growing, its last row may be a part of one, and its end the record's.
  if (FileState(spec_.file) != before) {
    throw UserError(spec_.file.string(), 0, "",
                    "was written to while it was read, expected a record that is complete");
  }

  const std::size_t rows = columns.front().size();
  if (rows < kFewestSamples) {
    throw UserError(spec_.file.string(), rows > 0 ? table_->LineOf(rows - 1) : 0, "",
                    std::to_string(rows) + kFewSamples);
  }
  Part part;
  Record record;
  if (spec_.time) {
    const std::vector<double>& time = columns.back();
    for (std::size_t i = 0; i < rows; ++i) {
      if (!std::isfinite(time[i])) {
        FailData(i, *spec_.time, NumberText(time[i]) + ", expected a finite time in s");
      }
    }
    const double resolution = TimeResolution(time);
    const double step = TypicalStep(time, resolution);
    if (step <= 0.0) {
      FailData(0, *spec_.time, "the times do not grow, expected even steps in s");
    }
    const double unit_s = TimeUnit(step);
    part = ChoosePart(rows, step * unit_s);
    CheckLength(part);
    record.sampling_hz = CheckTime(std::span(time).subspan(part.first, part.count), part.first,
                                   step, resolution, unit_s);
    columns.pop_back();
  } else {
    record.sampling_hz = *spec_.sampling_hz;
    part = ChoosePart(rows, 1.0 / *spec_.sampling_hz);
    CheckLength(part);
  }
  Take(columns[0], spec_.pressure, part, spec_.pressure_scale);
  record.pressure = std::move(columns[0]);
  if (spec_.heat_release) {
    Take(columns[1], *spec_.heat_release, part, spec_.heat_release_scale);
    record.heat_release = std::move(columns[1]);
  }
  TakeOutInstruments(spec_, config_file_, record);
  if (record.pressure.size() < kFewestSamples) {
    FailConfig("pressure_response",
               "leaves " + std::to_string(record.pressure.size()) + kFewSamples);
  }
  return record;
}

}  // namespace

Record LoadRecord(const RecordSpec& spec, const std::string& config_file, int config_line) {
  return Loader(spec, config_file, config_line).Load();
}

}  // namespace howl
