#include "diagnosis/numerics/hann_power.h"

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "model/numerics/fft.h"

namespace howl {

Eigen::VectorXd HannPower(const std::vector<double>& signal) {
  const std::size_t n = signal.size();
  std::vector<double> windowed(n);
  double weights = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = 2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5);
    const double weight = 1.0 - std::cos(phase / static_cast<double>(n));
    windowed[i] = weight * signal[i];
    weights += weight * weight;
  }
  std::vector<std::complex<double>> spectrum(n / 2 + 1);
  Fft::OfThisThread().Forward(windowed, spectrum);
  const Eigen::Map<const Eigen::VectorXcd> x(spectrum.data(),
                                             static_cast<Eigen::Index>(spectrum.size()));
  return x.cwiseAbs2() / weights;
}

}  // namespace howl
