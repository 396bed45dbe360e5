// Discrete Fourier transforms of lengths with a large prime factor, for which kissfft takes as many
// steps for each value as that factor is large. With 2 n k = n^2 + k^2 - (k - n)^2 the sum is a
// convolution (Bluestein 1970), which transforms of a smooth length make:
//
//   X_k = w_k sum_n (x_n w_n) conj(w_(k-n)),   w_n = e^(-pi j n^2 / N)
#ifndef HOWL_MODEL_NUMERICS_CHIRP_TRANSFORM_H_
#define HOWL_MODEL_NUMERICS_CHIRP_TRANSFORM_H_

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <span>
#include <unsupported/Eigen/FFT>

namespace howl {

// Whether kissfft would take longer.
bool NeedsChirps(std::size_t length);

class ChirpTransform {
 public:
  // `fft` lives as long.
  ChirpTransform(std::size_t length, Eigen::FFT<double>* fft);

  // Both have `length` values.
  void Forward(std::span<const std::complex<double>> x, std::span<std::complex<double>> spectrum);

 private:
  Eigen::FFT<double>* fft_;
  Eigen::VectorXcd chirp_;   // w
  Eigen::VectorXcd filter_;  // the spectrum of conj(w)
  Eigen::VectorXcd padded_, product_;
};

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_CHIRP_TRANSFORM_H_
