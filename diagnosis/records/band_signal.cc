#include "diagnosis/records/band_signal.h"

#include "diagnosis/numerics/real_fft.h"

namespace howl {

Eigen::VectorXcd BandSpectrum(const CutRecord& record, const Eigen::VectorXd& signal,
                              Eigen::Index count) {
  return ForwardFft(signal).segment(record.first - kTapReach, count + 2 * kTapReach);
}

Eigen::VectorXd InTime(const CutRecord& record, const Eigen::VectorXcd& band) {
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(record.pressure_spectrum.size());
  spectrum.segment(record.first - kTapReach, band.size()) = band;
  return InverseFft(spectrum, record.samples);
}

}  // namespace howl
