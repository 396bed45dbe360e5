#include "model/numerics/fft.h"

#include <glog/logging.h>

#include <algorithm>
#include <map>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "model/numerics/chirp_transform.h"

namespace howl {

struct Fft::Plans {
  Eigen::FFT<double> fft{Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::HalfSpectrum};
  std::map<std::size_t, ChirpTransform> chirps;
  std::vector<std::complex<double>> values;

  // None for lengths that kissfft does fast.
  ChirpTransform* ChirpsOf(std::size_t length) {
    const auto known = chirps.find(length);
    if (known != chirps.end()) return &known->second;
    if (!NeedsChirps(length)) return nullptr;
    return &chirps.try_emplace(length, length, &fft).first->second;
  }
};

Fft::Fft() : plans_(std::make_unique<Plans>()) {}

Fft::~Fft() = default;

Fft& Fft::OfThisThread() {
  thread_local Fft fft;
  return fft;
}

void Fft::Forward(std::span<const double> signal, std::span<std::complex<double>> spectrum) {
  CHECK_EQ(spectrum.size(), signal.size() / 2 + 1);
  if (ChirpTransform* const chirps = plans_->ChirpsOf(signal.size())) {
    std::vector<std::complex<double>>& values = plans_->values;
    values.assign(signal.begin(), signal.end());
    chirps->Forward(values, values);
    std::copy_n(values.begin(), spectrum.size(), spectrum.begin());
    return;
  }
  plans_->fft.fwd(spectrum.data(), signal.data(), std::ssize(signal));
}

void Fft::Forward(std::span<const std::complex<double>> signal,
                  std::span<std::complex<double>> spectrum) {
  CHECK_EQ(spectrum.size(), signal.size());
  if (ChirpTransform* const chirps = plans_->ChirpsOf(signal.size())) {
    chirps->Forward(signal, spectrum);
    return;
  }
  plans_->fft.fwd(spectrum.data(), signal.data(), std::ssize(signal));
}

void Fft::Inverse(std::span<const std::complex<double>> spectrum, std::span<double> signal) {
  CHECK_EQ(spectrum.size(), signal.size() / 2 + 1);
  if (ChirpTransform* const chirps = plans_->ChirpsOf(signal.size())) {
    // The whole spectrum, conjugate: its transform is the signal times N, which is real.
    const std::size_t size = signal.size();
    std::vector<std::complex<double>>& values = plans_->values;
    values.resize(size);
    for (std::size_t k = 0; k < size; ++k) {
      values[k] = k < spectrum.size() ? std::conj(spectrum[k]) : spectrum[size - k];
    }
    values[0] = values[0].real();
    chirps->Forward(values, values);
    for (std::size_t n = 0; n < size; ++n) {
      signal[n] = values[n].real() / static_cast<double>(size);
    }
    return;
  }
  plans_->fft.inv(signal.data(), spectrum.data(), std::ssize(signal));
}

}  // namespace howl
