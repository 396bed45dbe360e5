#include "estimation/analysis/spectra/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace howl::spectrum_test {
namespace {

TEST(WelchSpectrum, WhiteNoiseHasItsLevelAndDegreesOfFreedom) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> x(100000);
  for (double& value : x) value = 2.0 * normal(random);
  const CrossSpectrum s = WelchSpectrum(x, {}, 1000.0, 512);
  double mean = 0, square = 0;
  int count = 0;
  for (std::size_t k = 8; k < 248; ++k, ++count) {
    mean += s.pp[k];
    square += s.pp[k] * s.pp[k];
  }
  mean /= count;
  const double variance = square / count - mean * mean;
  EXPECT_NEAR(mean, 4.0 / 500.0, 0.02 * 4.0 / 500.0);  // variance over the band of 500 Hz
  // Chi-square with 2 nu degrees of freedom: variance = mean^2 / nu.
  EXPECT_NEAR(mean * mean / variance, s.degrees_of_freedom, 0.25 * s.degrees_of_freedom);
}

TEST(WelchSpectrum, StrongLineDoesNotLeak) {
  constexpr double kFs = 1000.0;
  std::vector<double> x(16000);
  for (std::size_t t = 0; t < x.size(); ++t) {
    x[t] = std::cos(2 * M_PI * 100.3 * static_cast<double>(t) / kFs);
  }
  const CrossSpectrum s = WelchSpectrum(x, {}, kFs, 1024);
  const double peak = s.pp[static_cast<std::size_t>(std::llround(100.3 / s.bin_hz))];
  for (std::size_t k = 0; k < s.pp.size(); ++k) {
    if (std::abs(static_cast<double>(k) - 100.3 / s.bin_hz) < 5.0) continue;
    EXPECT_LT(s.pp[k], 1e-9 * peak) << k;
  }
}

TEST(WelchSpectrum, CrossSpectrumHasPsLagAndGain) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  std::vector<double> q(20000), p(20000);
  for (std::size_t t = 0; t < q.size(); ++t) {
    q[t] = normal(random);
    p[t] = t >= 3 ? 2.5 * q[t - 3] : 0.0;
  }
  const CrossSpectrum s = WelchSpectrum(p, q, 1000.0, 512);
  for (std::size_t k = 20; k < 240; k += 40) {
    const std::complex<double> h = s.qp[k] / s.qq[k];
    const std::complex<double> expected =
        std::polar(2.5, -2 * M_PI * s.Frequency(static_cast<int>(k)) * 0.003);
    EXPECT_LT(std::abs(h - expected), 0.05) << k;
  }
}

TEST(Demodulate, ToneHasItsAmplitudeAndPhaseInEveryBlock) {
  std::vector<double> x(5000);
  for (std::size_t t = 0; t < x.size(); ++t) {
    x[t] = 3.0 * std::cos(2 * M_PI * 201.7 * static_cast<double>(t) / 5000.0 + 0.4);
  }
  for (const auto& z : Demodulate(x, 5000.0, 201.7, 500).amplitude) {
    EXPECT_LT(std::abs(z - std::polar(3.0, 0.4)), 1e-4);
  }
}

}  // namespace
}  // namespace howl::spectrum_test
