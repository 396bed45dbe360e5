#include "diagnosis/noise/cut_noise.h"

#include <cmath>

#include "diagnosis/noise/noise_fit.h"

namespace howl {
namespace {

double Cost(const Eigen::VectorXcd& residual, const Eigen::VectorXd& variance,
            const std::vector<char>& masked, const Eigen::VectorXd& share) {
  if (share.size() == 0) return WhittleCost(residual, variance, masked);
  double sum = 0.0;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    if (masked[static_cast<std::size_t>(k)]) continue;
    sum += share[k] * (std::log(variance[k]) + std::norm(residual[k]) / variance[k]);
  }
  return sum / kBinCorrelation;
}

Eigen::VectorXd Weights(const Eigen::VectorXd& variance, const std::vector<char>& masked,
                        const Eigen::VectorXd& share) {
  Eigen::VectorXd weights = variance.cwiseInverse();
  if (share.size() > 0) weights = weights.cwiseProduct(share);
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    if (masked[static_cast<std::size_t>(k)]) weights[k] = 0.0;
  }
  return weights;
}

// A known shape times a smooth factor.
Eigen::VectorXd OnShape(const Eigen::VectorXcd& residual, const std::vector<char>& masked,
                        const Eigen::VectorXd& shape) {
  const Eigen::VectorXcd white = residual.cwiseQuotient(shape.cwiseSqrt().cast<Response>());
  return FlameNoise(white, masked).cwiseProduct(shape);
}

}  // namespace

Eigen::VectorXd FitAcousticNoise(const CutRecord& record, const Eigen::VectorXcd& residual,
                                 const Eigen::VectorXd& gain_squared) {
  const Eigen::VectorXd& shape = record.reference.acoustic_shape;
  return shape.size() == 0 ? AcousticNoise(residual, gain_squared, record.masked)
                           : OnShape(residual, record.masked, shape);
}

Eigen::VectorXd FitFlameNoise(const CutRecord& record, const Eigen::VectorXcd& residual) {
  const Eigen::VectorXd& shape = record.reference.flame_shape;
  return shape.size() == 0 ? FlameNoise(residual, record.masked)
                           : OnShape(residual, record.masked, shape);
}

double AcousticCost(const CutRecord& record, const Eigen::VectorXcd& residual,
                    const Eigen::VectorXd& variance) {
  return Cost(residual, variance, record.masked, record.reference.acoustic_share);
}

double FlameCost(const CutRecord& record, const Eigen::VectorXcd& residual,
                 const Eigen::VectorXd& variance) {
  return Cost(residual, variance, record.masked, record.flame_share);
}

Eigen::VectorXd AcousticWeights(const CutRecord& record, const Eigen::VectorXd& variance) {
  return Weights(variance, record.masked, record.reference.acoustic_share);
}

Eigen::VectorXd FlameWeights(const CutRecord& record, const Eigen::VectorXd& variance) {
  return Weights(variance, record.masked, record.flame_share);
}

}  // namespace howl
