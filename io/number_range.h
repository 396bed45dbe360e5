// The dynamic range that the arithmetic carries. Every number of a config is zero or has a
// magnitude within it; a record's signal moves by no less than its lower end, and no sample exceeds
// its upper.
//
// A double holds magnitudes from 1e-308 to 1e308. The estimators go up to the sixth power of a
// sample (the envelope's statistics) and the searches 1e9 to either side of a product of two
// numbers: with 1e-30 to 1e30 neither leaves a double.
#ifndef HOWL_IO_NUMBER_RANGE_H_
#define HOWL_IO_NUMBER_RANGE_H_

#include <cmath>

namespace howl {

inline constexpr double kLeastMagnitude = 1e-30;
inline constexpr double kMostMagnitude = 1e30;
inline constexpr const char* kMagnitudeWords = "from 1e-30 to 1e30";

inline bool IsCarried(double value) {
  const double magnitude = std::abs(value);
  return value == 0.0 || (magnitude >= kLeastMagnitude && magnitude <= kMostMagnitude);
}

}  // namespace howl

#endif  // HOWL_IO_NUMBER_RANGE_H_
