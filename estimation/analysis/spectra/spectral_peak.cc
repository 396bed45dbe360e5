#include "estimation/analysis/spectra/spectral_peak.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "estimation/analysis/spectra/lines.h"

namespace howl {

SpectralPeak FindPeak(const CrossSpectrum& spectrum, double highest_hz, double lowest_hz,
                      double sampling_hz, double false_alarm) {
  const double top = highest_hz > 0 ? highest_hz : 0.4 * sampling_hz;
  const int first = std::max(static_cast<int>(std::ceil(lowest_hz / spectrum.bin_hz)), 2);
  const int last =
      std::min(static_cast<int>(top / spectrum.bin_hz), static_cast<int>(spectrum.pp.size()) - 3);
  SpectralPeak peak;
  peak.test.low_hz = lowest_hz;
  peak.test.high_hz = std::min(top, last * spectrum.bin_hz);
  if (first >= last) {
    peak.test.high_hz = std::min(peak.test.high_hz, peak.test.low_hz);
    return peak;
  }
  const auto begin = spectrum.pp.begin();
  const int bin = static_cast<int>(std::max_element(begin + first, begin + last + 1) - begin);
  double sum = 0.0, moment = 0.0;
  for (int k = std::max(bin - 2, 1); k <= bin + 2; ++k) {
    sum += spectrum.pp[static_cast<std::size_t>(k)];
    moment += k * spectrum.pp[static_cast<std::size_t>(k)];
  }
  peak.frequency_hz = moment / sum * spectrum.bin_hz;
  peak.power = sum * spectrum.bin_hz;
  const std::vector<double> floor = NoiseFloor(spectrum.pp, spectrum.degrees_of_freedom);
  peak.noise_psd = floor[static_cast<std::size_t>(bin)];
  const double threshold =
      PeakThreshold(spectrum.degrees_of_freedom, last - first + 1, false_alarm);
  peak.significant = spectrum.pp[static_cast<std::size_t>(bin)] > threshold * peak.noise_psd;
  peak.test.frequency_hz = peak.frequency_hz;
  peak.test.over_floor = spectrum.pp[static_cast<std::size_t>(bin)] / peak.noise_psd;
  peak.test.threshold = threshold;
  return peak;
}

SpectralPeak PeakAtAnyResolution(std::span<const double> samples, double highest_hz,
                                 double lowest_hz, double sampling_hz) {
  // The lowest peak must lie beyond two main lobes of the window from zero, and the range must have
  // more bins than the floor's median needs.
  const double coarsest_hz = lowest_hz / (2.0 * kBlackmanHarrisMainLobeBins);
  const int finest = static_cast<int>(
      std::bit_floor(static_cast<unsigned>(static_cast<double>(samples.size()) / 3.5)));
  int resolutions = 1;
  while (sampling_hz / (finest >> resolutions) <= coarsest_hz && (finest >> resolutions) >= 64) {
    ++resolutions;
  }
  SpectralPeak peak;
  for (int halvings = 0; halvings < resolutions; ++halvings) {
    peak = FindPeak(WelchSpectrum(samples, {}, sampling_hz, finest >> halvings), highest_hz,
                    lowest_hz, sampling_hz, kPeakFalseAlarm / resolutions);
    if (peak.significant) break;
  }
  return peak;
}

}  // namespace howl
