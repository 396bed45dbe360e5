#include "estimation/record_fit/spectra/amplitude_about.h"

#include <cmath>
#include <complex>
#include <utility>

#include "estimation/record_fit/spectra/unitary_transform.h"

namespace howl {

Eigen::VectorXd SquaredAmplitudeAbout(double multiple, double reach, const Eigen::VectorXcd& edges,
                                      const RecordSpectra& record) {
  const Eigen::Index instants = record.Instants();
  const double scale =
      std::sqrt(static_cast<double>(instants) * record.bin_hz / record.sampling_hz);
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(instants / 2 + 1);
  for (Eigen::Index i = 0; i < edges.size(); ++i) {
    if (std::abs(record.edge_s[i].imag() - multiple) < reach) {
      spectrum[record.below.size() + i] = scale * edges[i];
    }
  }
  const Eigen::VectorXcd later = std::complex<double>(0.0, -1.0) * spectrum;
  return UnitarySignal(std::move(spectrum), instants).cwiseAbs2() +
         UnitarySignal(later, instants).cwiseAbs2();
}

}  // namespace howl
