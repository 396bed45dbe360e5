#include "diagnosis/numerics/real_fft.h"

#include <cstddef>
#include <span>

#include "model/numerics/fft.h"

namespace howl {
namespace {

template <typename Vector>
auto Values(Vector& vector) {
  return std::span(vector.data(), static_cast<std::size_t>(vector.size()));
}

}  // namespace

Eigen::VectorXcd ForwardFft(const Eigen::VectorXd& signal) {
  Eigen::VectorXcd spectrum(signal.size() / 2 + 1);
  Fft::OfThisThread().Forward(Values(signal), Values(spectrum));
  return spectrum;
}

Eigen::VectorXd InverseFft(const Eigen::VectorXcd& half_spectrum, Eigen::Index size) {
  Eigen::VectorXd signal(size);
  Fft::OfThisThread().Inverse(Values(half_spectrum), Values(signal));
  return signal;
}

}  // namespace howl
