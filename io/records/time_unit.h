// The unit of a time column by its name: `time_ms`, `t [ms]`, `Time (us)`, `time/s`.
#ifndef HOWL_IO_RECORDS_TIME_UNIT_H_
#define HOWL_IO_RECORDS_TIME_UNIT_H_

#include <optional>
#include <string_view>

namespace howl {

// Seconds in one unit of the column; nothing where the name has no unit that it knows (s, sec, ms,
// msec, us, µs, usec, ns). The unit stands last: in brackets, or after one of _ / , . - or a blank.
std::optional<double> TimeUnitOfName(std::string_view name);

// The unit that makes the times agree with a sampling rate given beside them: 1, 1e-3, 1e-6 or
// 1e-9, where one does within `tolerance` (relative); nothing where none does.
std::optional<double> TimeUnitOfRates(double rate_by_times_hz, double sampling_hz,
                                      double tolerance);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TIME_UNIT_H_
