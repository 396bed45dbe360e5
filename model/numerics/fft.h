// Discrete Fourier transforms, by Eigen's kissfft, of any length in N log N steps.
//
//   X_k = sum_n x_n e^(-2 pi j k n / N)
//
// A real signal has the half spectrum k = 0 ... N/2, the rest being its conjugate. Values are
// finite and far from the largest numbers: products are taken without a second look for infinities,
// which halves the time.
#ifndef HOWL_MODEL_NUMERICS_FFT_H_
#define HOWL_MODEL_NUMERICS_FFT_H_

#include <complex>
#include <memory>
#include <span>

namespace howl {

// Keeps the factors of every length that it has met, and its working space: not for two threads at
// once.
class Fft {
 public:
  Fft();
  ~Fft();
  Fft(const Fft&) = delete;
  Fft& operator=(const Fft&) = delete;

  // One that each thread keeps.
  static Fft& OfThisThread();

  // spectrum has signal.size() / 2 + 1 values.
  void Forward(std::span<const double> signal, std::span<std::complex<double>> spectrum);
  // spectrum has signal.size() values.
  void Forward(std::span<const std::complex<double>> signal,
               std::span<std::complex<double>> spectrum);
  // The real signal with this half spectrum of signal.size() / 2 + 1 values, scaled by 1 / N.
  void Inverse(std::span<const std::complex<double>> spectrum, std::span<double> signal);

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_FFT_H_
