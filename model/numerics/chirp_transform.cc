#include "model/numerics/chirp_transform.h"

#include <bit>
#include <cstdint>
#include <numbers>

namespace howl {
namespace {

// A generic factor p costs p complex multiplications for each value; transforms padded to a power
// of two of at least twice the length cost as much as p = 30 at lengths of 2^14, 50 at 2^18
// (bench/fft_bench.cc).
constexpr std::size_t kLargestFactor = 40;

// exp(-pi j n^2 / N). n^2 is taken modulo 2 N, so that the angle keeps its digits.
std::complex<double> Chirp(std::uint64_t n, std::uint64_t length) {
  const auto turns = static_cast<double>(n * n % (2 * length)) / static_cast<double>(length);
  return std::polar(1.0, -std::numbers::pi * turns);
}

}  // namespace

bool NeedsChirps(std::size_t length) {
  std::size_t rest = length;
  for (std::size_t factor = 2; factor <= kLargestFactor; ++factor) {
    while (rest > 1 && rest % factor == 0) rest /= factor;
  }
  return rest > 1;
}

ChirpTransform::ChirpTransform(std::size_t length, Eigen::FFT<double>* fft)
    : fft_(fft),
      chirp_(static_cast<Eigen::Index>(length)),
      padded_(static_cast<Eigen::Index>(std::bit_ceil(2 * length - 1))),
      product_(padded_.size()) {
  for (std::size_t n = 0; n < length; ++n) {
    chirp_[static_cast<Eigen::Index>(n)] = Chirp(n, length);
  }
  const Eigen::Index size = chirp_.size();
  padded_.setZero();
  padded_.head(size) = chirp_.conjugate();
  padded_.tail(size - 1) = chirp_.tail(size - 1).conjugate().reverse();
  filter_.resize(padded_.size());
  fft_->fwd(filter_.data(), padded_.data(), padded_.size());
}

void ChirpTransform::Forward(std::span<const std::complex<double>> x,
                             std::span<std::complex<double>> spectrum) {
  const Eigen::Index size = chirp_.size();
  padded_.setZero();
  padded_.head(size) = Eigen::Map<const Eigen::VectorXcd>(x.data(), size).cwiseProduct(chirp_);
  fft_->fwd(product_.data(), padded_.data(), padded_.size());
  product_.array() *= filter_.array();
  fft_->inv(padded_.data(), product_.data(), product_.size());
  Eigen::Map<Eigen::VectorXcd>(spectrum.data(), size) = padded_.head(size).cwiseProduct(chirp_);
}

}  // namespace howl
