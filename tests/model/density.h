// The power spectral density of samples, by Welch's average.
#ifndef HOWL_TESTS_MODEL_DENSITY_H_
#define HOWL_TESTS_MODEL_DENSITY_H_

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace howl {

// One-sided power spectral density at f, averaged over Hann-windowed segments.
inline double Density(const std::vector<double>& x, double rate_hz, double f,
                      std::size_t segment = 1000) {
  double sum = 0.0;
  int segments = 0;
  for (std::size_t begin = 0; begin + segment <= x.size(); begin += segment) {
    std::complex<double> z = 0.0;
    for (std::size_t i = 0; i < segment; ++i) {
      const double hann =
          std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(segment));
      z += x[begin + i] * hann * hann *
           std::polar(1.0, -2.0 * std::numbers::pi * f * static_cast<double>(i) / rate_hz);
    }
    sum += std::norm(z);
    ++segments;
  }
  return sum / segments * 2.0 / (rate_hz * 0.375 * static_cast<double>(segment));
}

}  // namespace howl

#endif  // HOWL_TESTS_MODEL_DENSITY_H_
