// What a column's name tells about its content: `time_ms`, `P1 [Pa]`, `PMT (V)`, `OH*`.
#ifndef HOWL_IO_INSPECT_COLUMN_WORDS_H_
#define HOWL_IO_INSPECT_COLUMN_WORDS_H_

#include <cstdint>
#include <string>

namespace howl {

enum class ColumnMeaning : std::uint8_t {
  kNone,  // the name says nothing: "Untitled 1", "ai0", "CH2"
  kTime,
  kPressure,
  kHeatRelease,
  kOther,        // temperature, flow, valve ...
  kSamplingRate  // a variable of one number: fs
};

struct ColumnWords {
  ColumnMeaning meaning = ColumnMeaning::kNone;
  std::string word;  // of the name, that says so: "PMT", or a unit, "Pa"
};

// Words of the name decide first, then its unit (in brackets, or behind the last _) where they tell
// nothing. Upper and lower case are the same.
ColumnWords MeaningOf(const std::string& name);

}  // namespace howl

#endif  // HOWL_IO_INSPECT_COLUMN_WORDS_H_
