#include "io/inspect/record_look.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "io/inspect/text_start.h"
#include "io/inspect/time_guess.h"
#include "io/records/columns/number_text.h"
#include "io/records/open_table.h"
#include "io/records/records.h"
#include "io/user_error.h"

namespace howl {
namespace {

void TakeValues(std::vector<double> values, ColumnLook& look) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    look.min = count == 0 ? value : std::min(look.min, value);
    look.max = count == 0 ? value : std::max(look.max, value);
    sum += value;
    ++count;
  }
  look.not_finite = values.size() - count;
  look.info.samples = values.size();
  if (count > 0) {
    look.mean = sum / static_cast<double>(count);
    double squares = 0.0;
    for (const double value : values) {
      if (std::isfinite(value)) squares += (value - look.mean) * (value - look.mean);
    }
    look.std = look.min < look.max ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
  }
  look.values = std::move(values);
}

// A file of arrays may hold more than the record, whose columns are those of the most common
// length.
std::size_t RecordLength(const std::vector<ColumnInfo>& columns) {
  std::map<std::size_t, int> counts;
  for (const ColumnInfo& column : columns) {
    if (column.problem.empty() && column.samples >= kFewestSamples) ++counts[column.samples];
  }
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
        return std::pair(a.second, a.first) < std::pair(b.second, b.first);
      });
  return most == counts.end() ? 0 : most->first;
}

// A variable of one number that is named as a rate.
void TakeStatedRate(const std::filesystem::path& file, const std::vector<ColumnInfo>& columns,
                    const TableSource& table, TimeGuess& time) {
  if (const auto rate_hz = table.StatedRateHz()) {
    time.sampling_hz = rate_hz;
    time.sampling_reason = "Delta_X in the file's header";
    return;
  }
  for (const ColumnInfo& column : columns) {
    if (column.samples != 1 || !column.problem.empty()) continue;
    if (MeaningOf(column.label).meaning != ColumnMeaning::kSamplingRate) continue;
    const double value = OpenTable(file)->Read({column.name}).front().front();
    if (!(value > 0.0) || !std::isfinite(value)) continue;
    time.sampling_hz = value;
    time.sampling_reason = "the file's variable " + column.name;
    return;
  }
}

}  // namespace

std::size_t RecordLook::Samples() const {
  for (const ColumnLook& column : columns) {
    if (column.info.problem.empty()) return column.info.samples;
  }
  return 0;
}

std::string RecordLook::Layout() const {
  std::string text = format + "\n" + std::to_string(dialect.skip_rows) + "\n" + UnitText(time) +
                     "\n" + (time.column ? std::to_string(*time.column) : "") + "\n" +
                     NumberText(time.sampling_hz.value_or(0.0), 6) + "\n";
  for (const ColumnLook& column : columns) {
    text += column.info.name + "\n" + column.info.label + "\n" + column.info.problem + "\n";
  }
  return text;
}

RecordLook LookAtRecord(const std::filesystem::path& file) {
  RecordLook look;
  look.file = file;
  look.dialect = GuessDialectOf(file);
  const std::unique_ptr<TableSource> table = OpenTable(file, look.dialect);
  look.format = table->Format();
  const std::vector<ColumnInfo> columns = table->List();
  const std::size_t length = RecordLength(columns);
  std::vector<ColumnName> names;
  for (const ColumnInfo& column : columns) {
    if (column.samples != 0 && column.samples != length) continue;
    look.columns.push_back({column, MeaningOf(column.label), {}});
    if (column.problem.empty()) names.push_back(column.name);
  }
  if (names.empty()) {
    throw UserError(file.string(), 0, "",
                    "has no column of numbers, expected p, q or both (" + look.format + ")");
  }
  TakeStatedRate(file, columns, *table, look.time);
  Columns values = table->Read(names);
  std::size_t next = 0;
  for (ColumnLook& column : look.columns) {
    if (column.info.problem.empty()) TakeValues(std::move(values[next++]), column);
  }
  if (look.Samples() < kFewestSamples) {
    throw UserError(file.string(), 0, "",
                    std::to_string(look.Samples()) + " samples, expected at least " +
                        std::to_string(kFewestSamples));
  }
  GuessTime(look.columns, look.time);
  return look;
}

}  // namespace howl
