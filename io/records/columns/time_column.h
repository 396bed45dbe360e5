// Checks that the times of a record are one even grid, t_i = t_0 + i / f, up to the resolution of
// the numbers: an epoch time of 3.5e9 s holds no more than 5e-7 s in a double, and far less when
// few decimals were printed, which is no jitter of the sampling.
#ifndef HOWL_IO_RECORDS_COLUMNS_TIME_COLUMN_H_
#define HOWL_IO_RECORDS_COLUMNS_TIME_COLUMN_H_

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace howl {

// The step of the grid of decimal, float or double numbers on which all times lie, s.
double TimeResolution(std::span<const double> time_s);

// A step between neighbours that gaps and repetitions do not mislead, s; 0 when time stands still.
double TypicalStep(std::span<const double> time_s, double resolution_s);

struct TimeFault {
  std::size_t row = 0;
  std::string what;
};

// Times may be in any unit, of unit_s seconds: what is printed is in seconds. The first row whose
// step is no sampling period within 10 % and the resolution: a gap, jitter, or time that stands
// still or goes backwards. Steps of two resolutions or less cannot be told apart.
std::optional<TimeFault> FindTimeFault(std::span<const double> time_s, double step_s,
                                       double resolution_s, double unit_s = 1.0);

// f = (n - 1) / (t_(n-1) - t_0), and the shortest decimal number among those that the resolution
// cannot tell from it (10000 and not 10000.0017).
double SamplingRateHz(std::span<const double> time_s, double resolution_s);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_COLUMNS_TIME_COLUMN_H_
