// What is known of the mains' frequency.
#ifndef HOWL_DIAGNOSIS_SAMPLES_MAINS_H_
#define HOWL_DIAGNOSIS_SAMPLES_MAINS_H_

#include <array>

namespace howl {

inline constexpr std::array kMains_hz = {50.0, 60.0};

// Of the mains' frequency: 200 mHz of 50 Hz, the most that the grid of continental Europe may be
// off by for long (Regulation (EU) 2017/1485, annex III).
inline constexpr double kMainsWander = 0.004;

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SAMPLES_MAINS_H_
