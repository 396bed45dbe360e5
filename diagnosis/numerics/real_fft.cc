#include "diagnosis/numerics/real_fft.h"

#include <cstddef>
#include <span>

#include "model/numerics/fft.h"

namespace howl {
namespace {

// The transform keeps its factors. Each thread has one of its own, because it is not safe to share.
Fft& ThreadFft() {
  thread_local Fft fft;
  return fft;
}

template <typename Vector>
auto Values(Vector& vector) {
  return std::span(vector.data(), static_cast<std::size_t>(vector.size()));
}

}  // namespace

Eigen::VectorXcd ForwardFft(const Eigen::VectorXd& signal) {
  Eigen::VectorXcd spectrum(signal.size() / 2 + 1);
  ThreadFft().Forward(Values(signal), Values(spectrum));
  return spectrum;
}

Eigen::VectorXd InverseFft(const Eigen::VectorXcd& half_spectrum, Eigen::Index size) {
  Eigen::VectorXd signal(size);
  ThreadFft().Inverse(Values(half_spectrum), Values(signal));
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
