#include "estimation/analysis/instruments/autoregression.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace howl {
namespace {

// Of its order: after so many samples a process has forgotten that it began at zero.
constexpr std::size_t kOrdersBefore = 10;
constexpr double kLeastInnovation = 1e-12;  // of the variance

}  // namespace

// The inverse covariance is sum_j a_j a_(j+k) / s^2 at lag k, with a_0 = 1.
Autoregression::Autoregression(std::span<const double> autocovariance) {
  CHECK_GT(autocovariance.size(), 1u);
  CHECK_GT(autocovariance[0], 0.0);
  const auto order = static_cast<Eigen::Index>(autocovariance.size()) - 1;
  Eigen::MatrixXd toeplitz(order, order);
  for (Eigen::Index j = 0; j < order; ++j) {
    for (Eigen::Index i = j; i < order; ++i) {
      toeplitz(i, j) = autocovariance[static_cast<std::size_t>(i - j)];
    }
  }
  const Eigen::Map<const Eigen::VectorXd> behind(autocovariance.data() + 1, order);
  a_ = -toeplitz.selfadjointView<Eigen::Lower>().llt().solve(behind);
  // Rounding may leave nothing of what lines all but foretell.
  innovation_ =
      std::sqrt(std::max(autocovariance[0] + a_.dot(behind), kLeastInnovation * autocovariance[0]));
  const double at_zero = 1.0 + a_.squaredNorm();
  deviation_ = innovation_ / std::sqrt(at_zero);
  weights_.resize(order);
  for (Eigen::Index k = 1; k <= order; ++k) {
    weights_[k - 1] = -(a_[k - 1] + a_.head(order - k).dot(a_.tail(order - k))) / at_zero;
  }
}

double Autoregression::GivenAllOthers(std::span<const double> e, std::size_t t) const {
  double out = 0.0;
  for (std::size_t k = std::min(order(), t); k > 0; --k) {
    out += weights_[static_cast<Eigen::Index>(k - 1)] * e[t - k];
  }
  const std::size_t after = std::min(order(), e.size() - 1 - t);
  for (std::size_t k = 1; k <= after; ++k) {
    out += weights_[static_cast<Eigen::Index>(k - 1)] * e[t + k];
  }
  return out;
}

std::vector<double> Autoregression::Draw(std::size_t size, RandomStream* random) const {
  const std::size_t before = kOrdersBefore * order();
  std::vector<double> out(before + size);
  for (std::size_t t = 0; t < out.size(); ++t) {
    double next = innovation_ * random->Normal();
    for (std::size_t k = 1; k <= std::min(order(), t); ++k) {
      next -= a_[static_cast<Eigen::Index>(k - 1)] * out[t - k];
    }
    out[t] = next;
  }
  out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(before));
  return out;
}

}  // namespace howl
