#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "estimation/residuals/transfer_point.h"
#include "estimation/transfer.h"

namespace howl {
namespace {

// For given omega and xi the model is linear in N and M: the best start of a grid by linear least
// squares, M kept positive.
std::array<double, 4> GridStart(std::span<const TransferPoint> points, double ratio,
                                bool second_mode) {
  double best_cost = std::numeric_limits<double>::infinity();
  std::array<double, 4> best{};
  const double low = 0.5 * points.front().frequency_hz, high = 1.2 * points.back().frequency_hz;
  constexpr int kOmegas = 60;
  for (int i = 0; i < kOmegas; ++i) {
    const double omega_hz = low * std::pow(high / low, static_cast<double>(i) / (kOmegas - 1));
    for (double xi : {0.01, 0.03, 0.08, 0.15, 0.3, 0.7}) {
      Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
      Eigen::Vector2d rhs = Eigen::Vector2d::Zero();
      double total = 0;
      for (const TransferPoint& point : points) {
        const double w = 2.0 / (point.variance_re + point.variance_im);
        const double f = kRadPerSPerHz * point.frequency_hz;
        const Complex<double> a = UnitModeResponse(kRadPerSPerHz * omega_hz, xi, f);
        const Complex<double> b = UnitModeResponse(ratio * kRadPerSPerHz * omega_hz, xi, f);
        normal(0, 0) += w * SquaredMagnitude(a);
        normal(0, 1) += w * (a.re * b.re + a.im * b.im);
        normal(1, 1) += w * SquaredMagnitude(b);
        rhs(0) += w * (a.re * point.re + a.im * point.im);
        rhs(1) += w * (b.re * point.re + b.im * point.im);
        total += w * (point.re * point.re + point.im * point.im);
      }
      normal(1, 0) = normal(0, 1);
      Eigen::Vector2d x(rhs(0) / normal(0, 0), 0.0);
      if (second_mode) {
        const Eigen::Vector2d both = normal.inverse() * rhs;
        if (both(0) > 0.0 && both(1) > 0.0) x = both;
      }
      if (!(x(0) > 0.0)) continue;
      const double cost = total - 2.0 * x.dot(rhs) + x.dot(normal * x);
      if (cost < best_cost) {
        best_cost = cost;
        best = {std::log(omega_hz), std::log(xi), std::log(x(0)),
                std::log(std::max(x(1), 1e-3 * x(0)))};
      }
    }
  }
  return best;
}

}  // namespace

TransferFit FitTransfer(const Transfer& transfer, const TransferFitOptions& options) {
  TransferFit fit;
  const std::vector<TransferPoint>& points = transfer.points;
  if (points.size() < 4) return fit;
  std::array<double, 4> x = GridStart(points, options.harmonic_ratio, options.second_mode);
  if (x[0] == 0.0) return fit;
  if (!options.second_mode) x[3] = x[2] + std::log(1e-9);

  ceres::Problem problem;
  for (const TransferPoint& point : points) {
    problem.AddResidualBlock(TransferPointResidual::Create(point, options.harmonic_ratio), nullptr,
                             &x[0], &x[1], &x[2], &x[3]);
  }
  if (!options.second_mode) problem.SetParameterBlockConstant(&x[3]);
  problem.SetParameterLowerBound(&x[3], 0, x[2] + std::log(1e-9));
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 200;
  solver.function_tolerance = 1e-10;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  fit.available = summary.IsSolutionUsable();
  fit.acoustics = {std::exp(x[0]), std::exp(x[1]), std::exp(x[2]), std::exp(x[3]),
                   options.harmonic_ratio};

  std::vector<double> residuals;
  ceres::CRSMatrix jacobian;
  double cost = 0.0;
  problem.Evaluate({}, &cost, &residuals, nullptr, &jacobian);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(jacobian.num_cols, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(jacobian.num_cols);
    for (int i = jacobian.rows[static_cast<std::size_t>(row)];
         i < jacobian.rows[static_cast<std::size_t>(row) + 1]; ++i) {
      const auto k = static_cast<std::size_t>(i);
      gradient(jacobian.cols[k]) = jacobian.values[k];
    }
    normal += gradient * gradient.transpose();
  }
  const int free = options.second_mode ? 4 : 3;
  fit.log_covariance.topLeftCorner(free, free) =
      transfer.neighbour_inflation *
      normal.topLeftCorner(free, free).completeOrthogonalDecomposition().pseudoInverse();
  const double dof = 2.0 * static_cast<double>(points.size()) - free;
  fit.chi_square_per_dof = 2.0 * cost / dof;
  const double widening = std::sqrt(std::max(fit.chi_square_per_dof, 1.0));
  const auto estimate = [&](int i) {
    const double value = std::exp(x[static_cast<std::size_t>(i)]);
    return Estimate{value, value * widening * std::sqrt(fit.log_covariance(i, i))};
  };
  fit.omega_hz = estimate(0);
  fit.xi = estimate(1);
  fit.N = estimate(2);
  fit.M = estimate(3);

  double power = 0, missed = 0, noise = 0, within = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TransferPoint& point = points[i];
    const Complex<double> g = AcousticResponse(fit.acoustics, point.frequency_hz);
    const double size = point.re * point.re + point.im * point.im;
    const double error = SquaredMagnitude(Complex<double>{g.re - point.re, g.im - point.im});
    const double misfit = std::hypot(residuals[2 * i], residuals[2 * i + 1]);
    fit.points.push_back({point.frequency_hz, g.re, g.im, misfit, std::sqrt(error / size)});
    power += point.weight;
    missed += point.weight * error / size;
    noise += point.weight * (point.variance_re + point.variance_im) / size;
    within += misfit * misfit < 5.991 ? 1.0 : 0.0;  // chi-square, two degrees, 95 %
  }
  fit.explained_power = 1.0 - missed / power;
  fit.noise_power = noise / power;
  fit.points_within_95 = within / static_cast<double>(points.size());
  return fit;
}

}  // namespace howl
