// What was chosen for the paper's loop, carried over to a loop of another frequency: times are
// halved and rates doubled with every octave above the paper's 220 Hz (table 2: 219.9 Hz),
//
//   scale = 2^round(log2(f / 220 Hz))
//
// A power of two, so that a loop and the same loop run an octave faster are computed with the same
// bits; a factor of up to sqrt(2) does not matter to what is scaled so (rates of sampling, lengths
// of records, memories, limits of a search).
#ifndef HOWL_MODEL_SIMULATION_CYCLE_SCALE_H_
#define HOWL_MODEL_SIMULATION_CYCLE_SCALE_H_

#include <cmath>

namespace howl {

inline constexpr double kPaperFrequencyHz = 220.0;

inline double CycleScale(double frequency_hz) {
  return std::exp2(std::round(std::log2(frequency_hz / kPaperFrequencyHz)));
}

}  // namespace howl

#endif  // HOWL_MODEL_SIMULATION_CYCLE_SCALE_H_
