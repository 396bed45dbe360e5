// Where a record is and how to read it: the config's `record:` of one experiment.
#ifndef HOWL_IO_RECORD_SPEC_H_
#define HOWL_IO_RECORD_SPEC_H_

#include <filesystem>
#include <optional>
#include <string>

namespace howl {

// A column by its name in a header (or a variable or data set name in .mat and .h5 files), or by
// its number from 1 ("2").
using ColumnName = std::string;

struct RecordSpec {
  std::filesystem::path file;  // already relative to the working directory
  ColumnName pressure = "p";
  std::optional<ColumnName> heat_release;  // absent: pressure only
  std::optional<ColumnName> time;          // checked for gaps and jitter when present
  std::optional<double> sampling_hz;       // may be left out when `time` is given
  double pressure_scale = 1.0;             // recorded value * scale = value in units of p
  double heat_release_scale = 1.0;
  double start_s = 0.0;              // from the first sample
  std::optional<double> duration_s;  // absent: to the end
};

}  // namespace howl

#endif  // HOWL_IO_RECORD_SPEC_H_
