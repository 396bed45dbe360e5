#include "model/numerics/fft.h"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "model/numerics/smooth_length.h"

namespace howl::fft_test {
namespace {

using Spectrum = std::vector<std::complex<double>>;

std::vector<double> Signal(std::size_t size) {
  std::vector<double> signal(size);
  for (std::size_t n = 0; n < size; ++n) {
    const auto t = static_cast<double>(n);
    signal[n] = std::sin(0.7 * t) + 0.3 * std::cos(2.1 * t + 0.4) - 0.05 * t;
  }
  return signal;
}

// The definition, in N^2 steps.
std::complex<double> Sum(const std::vector<double>& signal, std::size_t k) {
  std::complex<double> sum;
  for (std::size_t n = 0; n < signal.size(); ++n) {
    sum += signal[n] *
           std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(k * n % signal.size()) /
                               static_cast<double>(signal.size()));
  }
  return sum;
}

// Lengths that the transform treats in ways of their own: multiples of four, even, odd, and those
// with a large prime factor.
class FftOfLength : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FftOfLength, IsTheDefinitionAndHasAnInverse) {
  const std::vector<double> signal = Signal(GetParam());
  Fft fft;
  Spectrum half(signal.size() / 2 + 1);
  fft.Forward(signal, half);
  Spectrum whole(signal.size());
  fft.Forward(Spectrum(signal.begin(), signal.end()), whole);
  for (std::size_t k = 0; k < half.size(); ++k) {
    const std::complex<double> expected = Sum(signal, k);
    EXPECT_LT(std::abs(half[k] - expected), 1e-10) << k;
    EXPECT_LT(std::abs(whole[k] - expected), 1e-10) << k;
  }
  std::vector<double> back(signal.size());
  fft.Inverse(half, back);
  for (std::size_t n = 0; n < signal.size(); ++n) EXPECT_NEAR(back[n], signal[n], 1e-12) << n;
}

INSTANTIATE_TEST_SUITE_P(Lengths, FftOfLength, ::testing::Values(16, 60, 66, 81, 97, 202, 1009));

TEST(SmoothLength, HasNoFactorAboveFive) {
  EXPECT_EQ(SmoothLength(16000), 16000);
  EXPECT_EQ(SmoothLength(16001), 16000);
  EXPECT_EQ(SmoothLength(997), 972);
  EXPECT_EQ(SmoothLengthFrom(16000), 16000);
  EXPECT_EQ(SmoothLengthFrom(16001), 16200);
  EXPECT_EQ(SmoothLengthFrom(997), 1000);
}

TEST(FftDeathTest, SpectraHaveTheirLength) {
  Spectrum spectrum(16);
  EXPECT_DEATH(Fft().Forward(Signal(16), spectrum), "Check failed");
}

}  // namespace
}  // namespace howl::fft_test
