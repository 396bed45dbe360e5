// Hum of the mains below the band of a fitted loop, where no likelihood sees it.
//
// Under Hann's window (hann_power.h) a line fills three bins. Where there is none, the power of a
// bin over the mean m of its flanks is above x with probability (1 + x / n)^-n, n values in the
// mean: a line is where that, times the bins tried, is below a millionth. Its share of the cycle is
//
//   sqrt(sum of the line's three bins less 3 m / sum of P from f / 2 to 3 f / 2)
//
// in which the window's factors are the same above and below.
#ifndef HOWL_DIAGNOSIS_SAMPLES_HUM_BELOW_BAND_H_
#define HOWL_DIAGNOSIS_SAMPLES_HUM_BELOW_BAND_H_

#include <vector>

namespace howl {

struct MainsLine {
  double of_cycle = 0.0;      // its amplitude over the cycle's in the same signal; 0: there is none
  double frequency_hz = 0.0;  // one to six times 50 or 60 Hz
};

// The strongest.
MainsLine HumBelowBand(const std::vector<double>& signal, double sampling_hz, double cycle_hz);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SAMPLES_HUM_BELOW_BAND_H_
