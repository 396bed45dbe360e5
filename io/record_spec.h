// Where a record is and how to read it: the config's `record:` of one experiment.
#ifndef HOWL_IO_RECORD_SPEC_H_
#define HOWL_IO_RECORD_SPEC_H_

#include <filesystem>
#include <optional>
#include <string>

#include "estimation/analysis/instruments/instrument_response.h"

namespace howl {

// A column by its name in a header (or a variable or data set name in .mat and .h5 files), or by
// its number from 1 ("2").
using ColumnName = std::string;

// A response of an instrument: a formula, or the file of a table with the columns frequency_hz,
// magnitude and phase_deg.
struct ResponseSpec {
  std::optional<InstrumentResponse> formula;
  std::filesystem::path table;  // without a formula; relative to the working directory
  int line = 0;                 // in the config
};

// The format of a text file, as far as the file does not tell it.
struct TextDialect {
  int skip_rows = 0;           // lines before the header or the first row
  bool decimal_comma = false;  // 0,5 is a half; columns are then parted by ; tabs or blanks

  bool operator==(const TextDialect&) const = default;
};

struct RecordSpec {
  std::filesystem::path file;  // already relative to the working directory
  TextDialect dialect;         // of a text file; none of its keys may be given for another
  ColumnName pressure = "p";
  std::optional<ColumnName> heat_release;  // absent: pressure only
  std::optional<ColumnName> time;          // checked for gaps and jitter when present
  std::optional<double> time_unit_s;       // absent: by the column's name, else seconds
  std::optional<double> sampling_hz;       // may be left out when `time` is given
  double pressure_scale = 1.0;             // recorded value * scale = value in units of p
  double heat_release_scale = 1.0;
  double start_s = 0.0;              // from the first sample
  std::optional<double> duration_s;  // absent: to the end
  // What is known of the instruments, which is removed from the record (remove_instruments.h).
  std::optional<ResponseSpec> pressure_response;
  std::optional<ResponseSpec> heat_release_response;
  double delay_s = 0.0;  // by how much heat release is recorded later than pressure
  int delay_line = 0;    // in the config
  double pressure_in_heat_release = 0.0;  // recorded p times this is in recorded q
  int pressure_in_heat_release_line = 0;  // in the config

  bool HasInstruments() const {
    return pressure_response || heat_release_response || delay_s != 0.0 ||
           pressure_in_heat_release != 0.0;
  }
  void ForgetInstruments() {
    pressure_response.reset();
    heat_release_response.reset();
    delay_s = pressure_in_heat_release = 0.0;
  }
};

}  // namespace howl

#endif  // HOWL_IO_RECORD_SPEC_H_
