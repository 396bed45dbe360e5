#include "estimation/analysis/flame/flame_dither.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/numerics/units.h"

namespace howl {
namespace {

// Fourier transform of a Hann window of unit length and unit area.
double HannResponse(double cycles) {
  const double x = std::abs(cycles);
  if (x < 1e-6) return 1.0;
  if (std::abs(x - 1.0) < 1e-6) return 0.5;
  return std::sin(std::numbers::pi * x) / (std::numbers::pi * x * (1.0 - x * x));
}

}  // namespace

double DitherVariance(const CrossSpectrum& spectrum, double frequency_hz, double block_s,
                      double top_hz) {
  const double nu = spectrum.degrees_of_freedom;
  if (!spectrum.HasHeatRelease() || nu < 2.0) return 0.0;
  double sum = 0.0;
  for (std::size_t k = 2; k < spectrum.pp.size(); ++k) {
    const double f = spectrum.Frequency(static_cast<int>(k));
    if (f > top_hz) break;
    const double harmonic = std::round(f / frequency_hz);
    if (harmonic > 1.0 && std::abs(f - harmonic * frequency_hz) <
                              (kBlackmanHarrisMainLobeBins + 0.5) * spectrum.bin_hz) {
      continue;
    }
    const double product = spectrum.pp[k] * spectrum.qq[k];
    if (!(product > 0.0)) continue;
    const double raw = std::norm(spectrum.qp[k]) / product;
    const double coherence = (nu * raw - 1.0) / (nu - 1.0);  // below zero too: zero on average
    const double followed = HannResponse((f - frequency_hz) * block_s);
    const double missed = 1.0 - followed * followed;
    const double rate = kRadPerSPerHz * f * missed;
    sum += rate * rate * coherence * spectrum.pp[k];
  }
  return std::max(sum, 0.0) * spectrum.bin_hz;
}

}  // namespace howl
