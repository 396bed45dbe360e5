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

using LogParameters = std::array<double, 4>;

// For given omega and xi the model is linear in N and M: the best start of a grid by linear least
// squares, M kept positive.
LogParameters GridStart(std::span<const TransferPoint> points, double ratio, bool second_mode) {
  double best_cost = std::numeric_limits<double>::infinity();
  LogParameters best{};
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

struct Solution {
  LogParameters x;
  std::vector<double> residuals;
  Eigen::MatrixXd normal;  // J^T J over the free parameters
  double cost = 0.0;
  bool usable = false;
};

Solution Solve(std::span<const TransferPoint> points, const TransferFitOptions& options,
               const LogParameters& start) {
  Solution solution{.x = start};
  LogParameters& x = solution.x;
  ceres::Problem problem;
  for (const TransferPoint& point : points) {
    problem.AddResidualBlock(
        TransferPointResidual::CreateFull(point, {options.harmonic_ratio, false}), nullptr, &x[0],
        &x[1], &x[2], &x[3]);
  }
  // Guard rails: a mode outside the points' band or without its N is another model.
  problem.SetParameterLowerBound(&x[1], 0, std::log(1e-4));
  problem.SetParameterUpperBound(&x[1], 0, std::log(10.0));
  if (options.second_mode) {
    problem.SetParameterLowerBound(&x[3], 0, x[2] + std::log(1e-6));
  } else {
    problem.SetParameterBlockConstant(&x[3]);
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 200;
  solver.function_tolerance = 1e-10;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  solution.usable = summary.IsSolutionUsable();

  ceres::CRSMatrix jacobian;
  problem.Evaluate({}, &solution.cost, &solution.residuals, nullptr, &jacobian);
  solution.normal = Eigen::MatrixXd::Zero(jacobian.num_cols, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(jacobian.num_cols);
    const auto r = static_cast<std::size_t>(row);
    for (int i = jacobian.rows[r]; i < jacobian.rows[r + 1]; ++i) {
      const auto k = static_cast<std::size_t>(i);
      gradient(jacobian.cols[k]) = jacobian.values[k];
    }
    solution.normal += gradient * gradient.transpose();
  }
  return solution;
}

std::vector<TransferPoint> WithModelError(std::span<const TransferPoint> points, double error) {
  std::vector<TransferPoint> result(points.begin(), points.end());
  for (TransferPoint& point : result) {
    const double variance = 0.5 * error * error * (point.re * point.re + point.im * point.im);
    point.variance_re += variance;
    point.variance_im += variance;
  }
  return result;
}

}  // namespace

TransferFit FitTransfer(const Transfer& transfer, const TransferFitOptions& options) {
  TransferFit fit;
  const auto within = [&](const TransferPoint& point) {
    return point.frequency_hz >= options.min_frequency_hz &&
           point.frequency_hz <= options.max_frequency_hz;
  };
  std::vector<TransferPoint> points;
  std::copy_if(transfer.points.begin(), transfer.points.end(), std::back_inserter(points), within);
  if (points.size() < 4) return fit;
  const int free = options.second_mode ? 4 : 3;
  const double dof = 2.0 * static_cast<double>(points.size()) - free;
  const auto solve = [&](double error) {
    const std::vector<TransferPoint> softened = WithModelError(points, error);
    LogParameters start = GridStart(softened, options.harmonic_ratio, options.second_mode);
    if (!options.second_mode) start[3] = start[2] + std::log(1e-9);
    return Solve(softened, options, start);
  };
  Solution solution = solve(0.0);
  fit.chi_square_per_dof = 2.0 * solution.cost / dof;
  if (fit.chi_square_per_dof > 1.5) {
    double low = 1e-3, high = 10.0;
    for (int i = 0; i < 12; ++i) {
      fit.model_error = std::sqrt(low * high);
      solution = solve(fit.model_error);
      (2.0 * solution.cost / dof > 1.0 ? low : high) = fit.model_error;
    }
  }
  const LogParameters& x = solution.x;
  fit.available = solution.usable;
  fit.acoustics = {std::exp(x[0]), std::exp(x[1]), std::exp(x[2]), std::exp(x[3]),
                   options.harmonic_ratio};
  fit.log_covariance.topLeftCorner(free, free) =
      transfer.neighbour_inflation * std::max(2.0 * solution.cost / dof, 1.0) *
      solution.normal.topLeftCorner(free, free).completeOrthogonalDecomposition().pseudoInverse();
  const auto estimate = [&](int i) {
    const double value = std::exp(x[static_cast<std::size_t>(i)]);
    return Estimate{value, value * std::sqrt(fit.log_covariance(i, i))};
  };
  fit.omega_hz = estimate(0);
  fit.xi = estimate(1);
  fit.N = estimate(2);
  fit.M = estimate(3);

  double power = 0, missed = 0, noise = 0, explained = 0;
  for (const TransferPoint& point : transfer.points) {
    const Complex<double> g =
        0.5 * (AcousticResponse(fit.acoustics, point.frequency_hz - point.spread_hz) +
               AcousticResponse(fit.acoustics, point.frequency_hz + point.spread_hz));
    const Eigen::Vector2d error(g.re - point.re, g.im - point.im);
    const double misfit = std::sqrt(error.dot(point.Covariance().ldlt().solve(error)));
    const double size = point.re * point.re + point.im * point.im;
    fit.points.push_back({point.frequency_hz, g.re, g.im, misfit,
                          std::sqrt(error.squaredNorm() / size), within(point)});
    power += point.weight;
    missed += point.weight * error.squaredNorm() / size;
    noise += point.weight * (point.variance_re + point.variance_im) / size;
    explained += misfit * misfit < 5.991 ? 1.0 : 0.0;  // chi-square, two degrees, 95 %
  }
  fit.explained_power = 1.0 - missed / power;
  fit.noise_power = noise / power;
  fit.points_within_95 = explained / static_cast<double>(transfer.points.size());
  return fit;
}

}  // namespace howl
