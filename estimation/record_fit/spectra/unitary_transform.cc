#include "estimation/record_fit/spectra/unitary_transform.h"

#include <cmath>
#include <cstddef>
#include <span>

#include "model/numerics/fft.h"

namespace howl {

Eigen::VectorXcd UnitarySpectrum(const Eigen::VectorXd& signal) {
  Eigen::VectorXcd out(signal.size() / 2 + 1);
  Fft::OfThisThread().Forward(std::span(signal.data(), static_cast<std::size_t>(signal.size())),
                              std::span(out.data(), static_cast<std::size_t>(out.size())));
  return out / std::sqrt(static_cast<double>(signal.size()));
}

Eigen::VectorXd UnitarySignal(Eigen::VectorXcd spectrum, Eigen::Index samples) {
  spectrum *= std::sqrt(static_cast<double>(samples));
  Eigen::VectorXd out(samples);
  Fft::OfThisThread().Inverse(std::span(spectrum.data(), static_cast<std::size_t>(spectrum.size())),
                              std::span(out.data(), static_cast<std::size_t>(out.size())));
  return out;
}

}  // namespace howl
