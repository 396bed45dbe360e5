#include "diagnosis/real_fft.h"

#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace howl {
namespace {

// The transform keeps its twiddle factors. Each thread has one of its own, because it is not safe
// to share.
Eigen::FFT<double>& ThreadFft() {
  thread_local Eigen::FFT<double> fft(Eigen::FFT<double>::impl_type(),
                                      Eigen::FFT<double>::HalfSpectrum);
  return fft;
}

}  // namespace

Eigen::VectorXcd ForwardFft(const Eigen::VectorXd& signal) {
  Eigen::VectorXcd spectrum(signal.size() / 2 + 1);
  ThreadFft().fwd(spectrum.data(), signal.data(), signal.size());
  return spectrum;
}

Eigen::VectorXd InverseFft(const Eigen::VectorXcd& half_spectrum, Eigen::Index size) {
  Eigen::VectorXd signal(size);
  ThreadFft().inv(signal.data(), half_spectrum.data(), size);
  return signal;
}

Eigen::Index SmoothLength(Eigen::Index size) {
  for (Eigen::Index n = size - size % 2; n > 2; n -= 2) {
    Eigen::Index rest = n;
    for (const Eigen::Index prime : {2, 3, 5}) {
      while (rest % prime == 0) rest /= prime;
    }
    if (rest == 1) return n;
  }
  return size;
}

}  // namespace howl
