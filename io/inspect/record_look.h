// Inspects a record's file of which nothing is known: its columns, what they hold, and which is
// time.
#ifndef HOWL_IO_INSPECT_RECORD_LOOK_H_
#define HOWL_IO_INSPECT_RECORD_LOOK_H_

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/inspect/column_words.h"
#include "io/records/columns/table_source.h"

namespace howl {

struct ColumnLook {
  ColumnInfo info;  // a problem: it was not read
  ColumnWords words;
  std::vector<double> values;
  std::size_t not_finite = 0;
  double mean = 0.0, std = 0.0, min = 0.0, max = 0.0;  // of the finite values

  bool IsSignal() const { return info.problem.empty() && std > 0.0; }
  // |mean| / std: how far a signal keeps away from zero.
  double MeanOverStd() const { return std > 0.0 ? (mean < 0 ? -mean : mean) / std : 0.0; }
};

// The guess, and the facts from which it was made.
struct TimeGuess {
  std::optional<std::size_t> column;  // absent: no column is time
  std::string column_reason;
  double unit_s = 1.0;
  bool unit_is_named = false;  // by the column's name, so that the config need not
  std::string unit_reason;
  std::optional<double> sampling_hz;  // by the times, or by what the file states
  std::string sampling_reason;
};

struct RecordLook {
  std::filesystem::path file;
  std::string format;
  TextDialect dialect;
  std::vector<ColumnLook> columns;
  TimeGuess time;

  std::size_t Samples() const;
  // Files that say the same here have the same columns in the same order.
  std::string Layout() const;
};

// Throws UserError where no reader makes columns of numbers of it.
RecordLook LookAtRecord(const std::filesystem::path& file);

}  // namespace howl

#endif  // HOWL_IO_INSPECT_RECORD_LOOK_H_
