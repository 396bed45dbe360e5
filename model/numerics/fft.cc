#include "model/numerics/fft.h"

#include <glog/logging.h>

#include <unsupported/Eigen/FFT>

namespace howl {

struct Fft::Plans {
  Eigen::FFT<double> fft{Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::HalfSpectrum};
};

Fft::Fft() : plans_(std::make_unique<Plans>()) {}

Fft::~Fft() = default;

void Fft::Forward(std::span<const double> signal, std::span<std::complex<double>> spectrum) {
  CHECK_EQ(spectrum.size(), signal.size() / 2 + 1);
  plans_->fft.fwd(spectrum.data(), signal.data(), std::ssize(signal));
}

void Fft::Forward(std::span<const std::complex<double>> signal,
                  std::span<std::complex<double>> spectrum) {
  CHECK_EQ(spectrum.size(), signal.size());
  plans_->fft.fwd(spectrum.data(), signal.data(), std::ssize(signal));
}

void Fft::Inverse(std::span<const std::complex<double>> spectrum, std::span<double> signal) {
  CHECK_EQ(spectrum.size(), signal.size() / 2 + 1);
  plans_->fft.inv(signal.data(), spectrum.data(), std::ssize(signal));
}

}  // namespace howl
