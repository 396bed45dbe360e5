#include "diagnosis/noise/noise_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/records/cut_record.h"
#include "estimation/analysis/spectra/statistics.h"

namespace howl {
namespace {

constexpr int kIterations = 40;
constexpr double kConverged = 1e-5;

double TypicalPower(const Eigen::VectorXcd& residual, Eigen::Index from) {
  std::vector<double> power;
  for (Eigen::Index k = from; k < residual.size(); ++k) power.push_back(std::norm(residual[k]));
  return std::max((power.empty() ? 1.0 : Median(power)) / std::log(2.0), 1e-300);
}

}  // namespace

Eigen::VectorXd AcousticNoise(const Eigen::VectorXcd& residual, const Eigen::VectorXd& gain_squared,
                              const std::vector<char>& masked) {
  const Eigen::Index n = residual.size();
  double log_p = std::log(TypicalPower(residual, n / 2));
  double log_q = log_p - std::log(std::max(gain_squared.mean(), 1e-300)) - 2.0;
  for (int i = 0; i < kIterations; ++i) {
    const double sp = std::exp(log_p);
    const double sq = std::exp(log_q);
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d curvature = Eigen::Matrix2d::Identity() * 1e-6 * static_cast<double>(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      if (masked[static_cast<std::size_t>(k)]) continue;
      const double v = sp + gain_squared[k] * sq;
      const double misfit = 1.0 - std::min(std::norm(residual[k]) / v, kNoiseCap);
      const double a = sp / v;
      const double b = gain_squared[k] * sq / v;
      gradient += Eigen::Vector2d(a, b) * misfit;
      curvature(0, 0) += a * a;
      curvature(0, 1) += a * b;
      curvature(1, 1) += b * b;
    }
    curvature(1, 0) = curvature(0, 1);
    const Eigen::Vector2d step = -curvature.ldlt().solve(gradient).cwiseMax(-1.0).cwiseMin(1.0);
    log_p += step[0];
    log_q = std::max(log_q + step[1], log_p - 16.0);
    if (step.cwiseAbs().maxCoeff() < kConverged) break;
  }
  return std::exp(log_p) + std::exp(log_q) * gain_squared.array();
}

Eigen::VectorXd FlameNoise(const Eigen::VectorXcd& residual, const std::vector<char>& masked) {
  const Eigen::Index n = residual.size();
  Eigen::MatrixXd terms(n, kFlameNoiseTerms);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double x = 2.0 * static_cast<double>(k) / static_cast<double>(n - 1) - 1.0;
    terms(k, 0) = masked[static_cast<std::size_t>(k)] ? 0.0 : 1.0;
    terms(k, 1) = x * terms(k, 0);
    for (int j = 2; j < kFlameNoiseTerms; ++j) {
      terms(k, j) = 2.0 * x * terms(k, j - 1) - terms(k, j - 2);
    }
  }
  const Eigen::MatrixXd curvature = terms.transpose() * terms;
  const Eigen::LDLT<Eigen::MatrixXd> solver(curvature);
  Eigen::VectorXd c = Eigen::VectorXd::Zero(kFlameNoiseTerms);
  c[0] = std::log(TypicalPower(residual, 0));
  Eigen::VectorXd variance(n);
  for (int i = 0; i < kIterations; ++i) {
    variance = (terms * c).array().exp();
    const Eigen::VectorXd misfit =
        1.0 - (residual.cwiseAbs2().array() / variance.array()).min(kNoiseCap);
    const Eigen::VectorXd step =
        -solver.solve(terms.transpose() * misfit).cwiseMax(-1.0).cwiseMin(1.0);
    c += step;
    if (step.cwiseAbs().maxCoeff() < kConverged) break;
  }
  return (terms * c).array().exp();
}

double WhittleCost(const Eigen::VectorXcd& residual, const Eigen::VectorXd& variance,
                   const std::vector<char>& masked) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    if (masked[static_cast<std::size_t>(k)]) continue;
    sum += std::log(variance[k]) + std::norm(residual[k]) / variance[k];
  }
  return sum / kBinCorrelation;
}

}  // namespace howl
