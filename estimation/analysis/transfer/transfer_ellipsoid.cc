#include "estimation/analysis/transfer/transfer_ellipsoid.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "estimation/analysis/transfer/joint_deviation.h"
#include "estimation/analysis/transfer/transfer.h"

namespace howl {
namespace {

std::optional<TransferMatrix> FactorOf(const TransferMatrix& covariance,
                                       const std::vector<int>& used) {
  const Eigen::MatrixXd marginal = covariance(used, used);
  if (!marginal.allFinite() || Eigen::LLT<Eigen::MatrixXd>(marginal).info() != Eigen::Success) {
    return std::nullopt;
  }
  const Eigen::LLT<Eigen::MatrixXd> precision(marginal.inverse());
  if (precision.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd upper = precision.matrixU();
  TransferMatrix factor = TransferMatrix::Zero();
  factor(used, used) = upper;
  return factor;
}

}  // namespace

std::optional<TransferEllipsoid> TransferEllipsoid::Make(
    const TransferVector& centre, const TransferMatrix& covariance,
    const std::array<bool, kNumTransferParameters>& determined) {
  TransferEllipsoid ellipsoid;
  ellipsoid.centre_ = centre;
  ellipsoid.covariance_ = covariance;
  ellipsoid.determined_ = determined;
  std::vector<int> used;
  for (int k = 0; k < kNumTransferParameters; ++k) {
    if (determined[static_cast<std::size_t>(k)]) used.push_back(k);
  }
  if (used.empty() || !centre.allFinite() || !(centre.minCoeff() > 0.0)) return std::nullopt;
  const std::optional<TransferMatrix> two = FactorOf(covariance, used);
  if (!two) return std::nullopt;
  ellipsoid.two_ = *two;
  if (used.back() == kNumTransferParameters - 1) used.pop_back();
  if (!used.empty()) {
    const std::optional<TransferMatrix> one = FactorOf(covariance, used);
    if (!one) return std::nullopt;
    ellipsoid.one_ = *one;
  }
  return ellipsoid;
}

std::optional<TransferEllipsoid> MakeTransferEllipsoid(const TransferFit& fit,
                                                       double largest_relative_std) {
  if (!fit.available) return std::nullopt;
  const Acoustics<double>& g = fit.acoustics;
  // With one mode nothing is known of M, which its variance of zero marks below.
  const TransferVector centre(g.omega_hz, g.xi, g.N, g.M > 0.0 ? g.M : 1.0);
  std::array<bool, kNumTransferParameters> determined{};
  for (int k = 0; k < kNumTransferParameters; ++k) {
    const double variance = fit.log_covariance(k, k);
    determined[static_cast<std::size_t>(k)] =
        variance > 0.0 && variance < largest_relative_std * largest_relative_std;
  }
  return TransferEllipsoid::Make(centre, fit.log_covariance, determined);
}

int TransferEllipsoid::Count(bool second_mode) const {
  const int rest = kNumTransferParameters - 1;
  int count = second_mode && IsDetermined(rest) ? 1 : 0;
  for (int k = 0; k < rest; ++k) count += IsDetermined(k) ? 1 : 0;
  return count;
}

double MahalanobisDistance(const TransferEllipsoid& ellipsoid, const LoopModel& model) {
  const bool second_mode = model.M > 0.0;
  const TransferVector& centre = ellipsoid.Centre();
  const TransferVector offset(std::log(model.omega_hz / centre(0)), std::log(model.xi / centre(1)),
                              model.N / centre(2) - 1.0,
                              second_mode ? model.M / centre(3) - 1.0 : 0.0);
  return (ellipsoid.Factor(second_mode) * offset).norm();
}

double TransferDistance(const TransferEllipsoid& ellipsoid, const LoopModel& model) {
  const int count = ellipsoid.Count(model.M > 0.0);
  return count > 0 ? DeviationOfDistance(MahalanobisDistance(ellipsoid, model), count) : 0.0;
}

}  // namespace howl
