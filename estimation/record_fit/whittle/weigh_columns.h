// Slopes over a chunk of bins, weighted: for each column y of complex numbers, whose real and
// imaginary parts stand one below the other,
//
//   x^T out = sum over bins of Re(x alpha y + x beta conj(y))
//
// for any x that stands likewise.
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_WEIGH_COLUMNS_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_WEIGH_COLUMNS_H_

#include <complex>
#include <cstddef>

namespace howl {

// Bins that are taken at once: what they need stays in the processor's nearest memory.
inline constexpr std::ptrdiff_t kChunk = 64;

// Real parts at kChunk rows, imaginary parts at the next kChunk; from one column to the next it is
// `stride`.
struct SlopeColumns {
  const double* first = nullptr;
  std::ptrdiff_t stride = 0;
  std::ptrdiff_t count = 0;
};

// Of the first `bins` of a chunk; alpha: null for zeros.
void WeighColumns(const std::complex<double>* alpha, const std::complex<double>* beta,
                  std::ptrdiff_t bins, const SlopeColumns& y, double* out, std::ptrdiff_t stride);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_WEIGH_COLUMNS_H_
