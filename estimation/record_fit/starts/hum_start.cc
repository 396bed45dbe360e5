#include "estimation/record_fit/starts/hum_start.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/record_fit/whittle/noise_shape.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr double kOnLine = 0.5;  // of what the taper passes of a line
// Of the coefficients, which are one more than there are lines.
constexpr double kRidge = 1e-3;

}  // namespace

Eigen::VectorXd HumStart(const RecordSpectra& record, const NoiseTerm& hum,
                         const LoopResiduals& left) {
  const Eigen::VectorXd shape = NoiseShape(hum, record);
  Eigen::VectorXd power =
      (hum.source == LoopNoise::kTone || IsOfPressure(hum.source) ? left.acoustic : left.flame)
          .cwiseAbs2();
  if (hum.source == LoopNoise::kTone) power = power.cwiseQuotient(left.r.cwiseAbs2());
  std::vector<Eigen::Index> bins;
  for (Eigen::Index i = 0; i < shape.size(); ++i) {
    if (shape[i] > kOnLine) bins.push_back(i);
  }
  if (bins.empty()) {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(hum.coefficients);
    out[0] = std::log(std::max(power.mean(), 1e-300));
    return out;
  }
  const Eigen::MatrixXd basis = LogSpectrumColumns(hum, record)(bins, Eigen::all);
  const Eigen::VectorXd level = power(bins).array().max(1e-300).log();
  Eigen::MatrixXd normal = basis.transpose() * basis;
  normal.diagonal().array() += kRidge;
  return SolveSymmetric(normal, basis.transpose() * level);
}

}  // namespace howl
