#include "model/noise/periodic_noise.h"

#include <cmath>
#include <complex>

#include "model/noise/random_stream.h"
#include "model/numerics/fft.h"

namespace howl {

std::vector<double> PeriodicNoise(const PowerDensity& density, double rate_hz, std::size_t samples,
                                  std::uint64_t seed) {
  std::vector<double> out(samples);
  std::vector<std::complex<double>> spectrum(samples / 2 + 1);
  RandomStream random(seed);
  const auto count = static_cast<double>(samples);
  // Half of the rate stands for itself alone, and is left out as the mean is.
  for (std::size_t k = 1; 2 * k < samples; ++k) {
    const double f_hz = static_cast<double>(k) * rate_hz / count;
    const double part = std::sqrt(0.25 * density(f_hz) * rate_hz * count);
    const double real = random.Normal();
    spectrum[k] = {part * real, part * random.Normal()};
  }
  Fft().Inverse(spectrum, out);
  return out;
}

std::size_t FastPeriod(std::size_t least) {
  for (std::size_t n = least + least % 2;; n += 2) {
    std::size_t left = n;
    for (const std::size_t factor : {2, 3, 5}) {
      while (left > 1 && left % factor == 0) left /= factor;
    }
    if (left == 1) return n;
  }
}

}  // namespace howl
