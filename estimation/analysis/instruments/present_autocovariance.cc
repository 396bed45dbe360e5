#include "estimation/analysis/instruments/present_autocovariance.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "model/numerics/fft.h"
#include "model/numerics/smooth_length.h"

namespace howl {
namespace {

constexpr double kLeastPower = 1e-3;  // of the median over all frequencies

// sum_t x_t x_(t+lag) for lag = 0 ... lags - 1.
std::vector<double> LaggedProducts(std::span<const double> x, std::size_t lags) {
  std::vector<double> padded(
      static_cast<std::size_t>(SmoothLengthFrom(static_cast<std::ptrdiff_t>(x.size() + lags))),
      0.0);
  std::ranges::copy(x, padded.begin());
  std::vector<std::complex<double>> spectrum(padded.size() / 2 + 1);
  Fft::OfThisThread().Forward(padded, spectrum);
  for (std::complex<double>& value : spectrum) value = std::norm(value);
  Fft::OfThisThread().Inverse(spectrum, padded);
  padded.resize(lags);
  return padded;
}

}  // namespace

std::vector<double> PresentAutocovariance(std::span<const double> x,
                                          const std::vector<bool>& present, std::size_t lags) {
  std::vector<double> values(x.size(), 0.0);
  std::vector<double> ones(x.size(), 0.0);
  for (std::size_t t = 0; t < x.size(); ++t) {
    if (!present[t]) continue;
    values[t] = x[t];
    ones[t] = 1.0;
  }
  const std::vector<double> sums = LaggedProducts(values, lags);
  const std::vector<double> pairs = LaggedProducts(ones, lags);
  std::vector<double> windowed(2 * lags, 0.0);
  for (std::size_t k = 0; k < lags; ++k) {
    const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(lags);
    windowed[k] = 0.5 * (1.0 + std::cos(angle)) * sums[k] / std::max(pairs[k], 1.0);
    if (k > 0) windowed[2 * lags - k] = windowed[k];
  }
  std::vector<std::complex<double>> power(lags + 1);
  Fft::OfThisThread().Forward(windowed, power);
  std::vector<double> sizes;
  for (const std::complex<double>& value : power) sizes.push_back(std::abs(value.real()));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::ranges::nth_element(sizes, middle);
  for (std::complex<double>& value : power) {
    value = std::max(value.real(), kLeastPower * *middle);
  }
  Fft::OfThisThread().Inverse(power, windowed);
  windowed.resize(lags);
  return windowed;
}

}  // namespace howl
