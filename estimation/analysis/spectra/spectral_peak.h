// The highest peak of p's spectrum in a range of frequencies, where a limit cycle is looked for.
//
// It is a cycle's only if it stands out of the noise floor (lines.h: NoiseFloor) by more than noise
// does in any bin of the range with probability alpha. The floor is a running median over 61 bins:
// a peak wider than half of them hides its own floor, as one of a cycle whose phase wanders does in
// a long record, whose bins are fine. PeakAtAnyResolution then halves the segment, and the bins'
// width doubles, until the peak stands out; alpha is shared among the resolutions.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_SPECTRAL_PEAK_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_SPECTRAL_PEAK_H_

#include <span>

#include "estimation/analysis/spectra/spectrum.h"

namespace howl {

// The highest peak of p's spectrum in the search range, and the threshold that a cycle's must
// exceed.
struct PeakTest {
  double low_hz = 0.0, high_hz = 0.0;  // the range; empty where low_hz >= high_hz
  double frequency_hz = 0.0;
  double over_floor = 0.0;  // the spectrum there over the noise beside it
  double threshold = 0.0;   // of over_floor
};

struct SpectralPeak {
  double frequency_hz = 0.0;  // refined by the main lobe's centroid
  double noise_psd = 0.0;     // floor beside it
  double power = 0.0;         // mean square
  bool significant = false;
  PeakTest test;
};

inline constexpr double kPeakFalseAlarm = 0.01;  // alpha

// highest_hz = 0: four tenths of the sampling rate.
SpectralPeak FindPeak(const CrossSpectrum& spectrum, double highest_hz, double lowest_hz,
                      double sampling_hz, double false_alarm = kPeakFalseAlarm);

// The peak at the finest resolution at which it is significant; `samples` are free of their mean.
SpectralPeak PeakAtAnyResolution(std::span<const double> samples, double highest_hz,
                                 double lowest_hz, double sampling_hz);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_SPECTRAL_PEAK_H_
