#include "estimation/record_fit/whittle/weigh_columns.h"

#include "model/numerics/vector_clones.h"

namespace howl {

HOWL_VECTOR_CLONES
void WeighColumns(const std::complex<double>* alpha, const std::complex<double>* beta,
                  std::ptrdiff_t bins, const SlopeColumns& y, double* out, std::ptrdiff_t stride) {
  double real_real[kChunk];
  double real_imag[kChunk];
  double imag_real[kChunk];
  double imag_imag[kChunk];
  for (std::ptrdiff_t b = 0; b < bins; ++b) {
    const double re = alpha == nullptr ? 0.0 : alpha[b].real();
    const double im = alpha == nullptr ? 0.0 : alpha[b].imag();
    real_real[b] = re + beta[b].real();
    real_imag[b] = beta[b].imag() - im;
    imag_real[b] = -(im + beta[b].imag());
    imag_imag[b] = beta[b].real() - re;
  }
  for (std::ptrdiff_t column = 0; column < y.count; ++column) {
    const double* const real = y.first + column * y.stride;
    const double* const imag = real + kChunk;
    double* const out_real = out + column * stride;
    double* const out_imag = out_real + kChunk;
    for (std::ptrdiff_t b = 0; b < bins; ++b) {
      out_real[b] = real_real[b] * real[b] + real_imag[b] * imag[b];
      out_imag[b] = imag_real[b] * real[b] + imag_imag[b] * imag[b];
    }
  }
}

}  // namespace howl
