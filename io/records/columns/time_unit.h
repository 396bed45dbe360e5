// The unit of a time column by its name: `time_ms`, `t [ms]`, `Time (us)`, `time/s`.
#ifndef HOWL_IO_RECORDS_COLUMNS_TIME_UNIT_H_
#define HOWL_IO_RECORDS_COLUMNS_TIME_UNIT_H_

#include <optional>
#include <string_view>

namespace howl {

// Seconds in one unit of the column; no value where the name has no unit that it knows (s, sec, ms,
// msec, us, µs, usec, ns). The unit stands last: in brackets, or after one of _ / , . - or a blank.
std::optional<double> TimeUnitOfName(std::string_view name);

// Seconds in s, ms, us, ns or another name of a unit that stands alone; no value for other text.
std::optional<double> SecondsOfUnit(std::string_view unit);

// "s", "ms", "us" or "ns" of 1, 1e-3, 1e-6 or 1e-9: as `time_unit` has it.
std::string_view UnitOfSeconds(double unit_s);

// The unit that makes the times agree with a sampling rate given beside them: 1, 1e-3, 1e-6 or
// 1e-9, where one does within `tolerance` (relative); no value where none does.
std::optional<double> TimeUnitOfRates(double rate_by_times_hz, double sampling_hz,
                                      double tolerance);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_COLUMNS_TIME_UNIT_H_
