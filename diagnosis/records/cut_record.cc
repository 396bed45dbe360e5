#include "diagnosis/records/cut_record.h"

#include <cmath>
#include <complex>

#include "diagnosis/numerics/real_fft.h"

namespace howl {

Eigen::VectorXcd ApplyWindow(const Eigen::Ref<const Eigen::VectorXcd>& extended,
                             Eigen::Index count) {
  // Real and imaginary parts are stored side by side, two numbers for each bin.
  const Eigen::Map<const Eigen::VectorXd> in(reinterpret_cast<const double*>(extended.data()),
                                             2 * extended.size());
  Eigen::VectorXcd out(count);
  Eigen::Map<Eigen::VectorXd> to(reinterpret_cast<double*>(out.data()), 2 * count);
  const Eigen::Index n = 2 * count;
  to = kWindowTaps[0] * in.segment(4, n) + kWindowTaps[1] * (in.segment(2, n) + in.segment(6, n)) +
       kWindowTaps[2] * (in.segment(0, n) + in.segment(8, n));
  return out;
}

Eigen::ArrayXd SquaredAmplitude(const CutRecord& record, const AmplitudeSense& sense,
                                double delay_s) {
  Eigen::VectorXcd spectrum = sense.of_rate ? record.rate_square_spectrum : record.square_spectrum;
  const double lag_s = sense.memory_s / sense.lags;
  for (Eigen::Index k = 1; k < spectrum.size(); ++k) {
    const Response s = LaplaceVariable(static_cast<double>(k) * record.bin_hz);
    const Response lag = 1.0 / (1.0 + lag_s * s);
    for (int i = 0; i < sense.lags; ++i) spectrum[k] *= lag;
    if (delay_s != 0.0) spectrum[k] *= std::exp(-delay_s * s);
  }
  if (sense.over_own) {
    const double own =
        sense.of_rate ? record.at.relative_rate_amplitude : record.at.relative_amplitude;
    spectrum /= own * own;
  }
  return InverseFft(spectrum, record.samples).array().max(0.0);
}

}  // namespace howl
