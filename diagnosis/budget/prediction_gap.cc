#include "diagnosis/budget/prediction_gap.h"

#include <Eigen/Core>

namespace howl {

std::vector<BandErrors> PredictionErrors(const JointBand& band, const JointResiduals& residuals,
                                         const JointEvaluation& at) {
  const Eigen::Index n = band.count;
  PredictedSignals signals{.cycle_hz = band.record.at.cycle_frequency_hz,
                           .bin_hz = band.record.bin_hz,
                           .frequency_hz = band.frequency_hz,
                           .share = band.share,
                           .pressure = band.pressure,
                           .heat_release = band.heat_release,
                           .pressure_power = band.pressure_power,
                           .heat_release_power = band.heat_release_power,
                           .pressure_error = Eigen::VectorXcd(n),
                           .heat_release_error = Eigen::VectorXcd(n)};
  const Eigen::VectorXcd left = residuals.flame->target - residuals.flame->columns * at.flame;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Matrix2cd& w = at.inverse[static_cast<std::size_t>(i)];
    SetPredictionErrors({residuals.acoustic->residual[i], left[i]}, w, residuals.acoustic->r[i],
                        at.f[i], i, &signals);
  }
  return ErrorsOverBands(signals);
}

}  // namespace howl
