#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "estimation/analysis/transfer/transfer.h"
#include "estimation/analysis/transfer/transfer_point_residual.h"
#include "estimation/analysis/transfer/transfer_search.h"
#include "model/loop/second_mode.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

using LogParameters = std::array<double, 4>;

// For given omega and xi the model is linear in N and M: the best start of a grid by linear least
// squares, M kept positive.
LogParameters GridStart(std::span<const TransferPoint> points, const ModelSpec& model,
                        const TransferBand& band,
                        const std::optional<FirstModeCarries>& first_mode) {
  const double ratio = model.harmonic_ratio;
  const bool second_mode = model.modes == 2;
  double best_cost = std::numeric_limits<double>::infinity();
  LogParameters best{};
  double low = 0.5 * points.front().frequency_hz, high = 1.2 * points.back().frequency_hz;
  if (second_mode && band.cycle_frequency_hz > 0.0) {
    low = band.cycle_frequency_hz / std::sqrt(ratio);
    high = band.cycle_frequency_hz * std::sqrt(ratio);
  }
  constexpr int kOmegas = 60;
  for (int i = 0; i < kOmegas; ++i) {
    const double omega_hz = low * std::pow(high / low, static_cast<double>(i) / (kOmegas - 1));
    for (double xi : {0.01, 0.03, 0.08, 0.15, 0.3, 0.7}) {
      Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
      Eigen::Vector2d rhs = Eigen::Vector2d::Zero();
      double total = 0;
      for (const TransferPoint& point : points) {
        const double w = 2.0 / point.TotalCovariance().trace();
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
      const double second = std::max(x(1), 1e-3 * x(0));
      if (second_mode && first_mode &&
          SecondModeShare(Acoustics<double>{omega_hz, xi, x(0), second, ratio},
                          first_mode->frequency_hz) > first_mode->second_mode_share_max) {
        continue;
      }
      const double cost = total - 2.0 * x.dot(rhs) + x.dot(normal * x);
      if (cost < best_cost) {
        best_cost = cost;
        best = {std::log(omega_hz), std::log(xi), std::log(x(0)), std::log(second)};
      }
    }
  }
  if (!std::isfinite(best_cost) && first_mode) {
    return GridStart(points, model, band, std::nullopt);
  }
  return best;
}

struct Solution {
  LogParameters x;
  double q_noise = 0.0;      // u (estimation/analysis/transfer/transfer_point_residual.h)
  Eigen::MatrixXd jacobian;  // of the points' whitened residuals over the free parameters, u last
  std::vector<double> misfits;  // the points' whitened residuals, two for each
  double cost = 0.0;            // of the points alone
  bool usable = false;
};

Solution Solve(std::span<const TransferPoint> points, const ModelSpec& model,
               const TransferBand& band, const LogParameters& start) {
  Solution solution{.x = start};
  LogParameters& x = solution.x;
  double* const u = &solution.q_noise;
  ceres::Problem problem;
  for (const TransferPoint& point : points) {
    if (model.modes == 2) {
      problem.AddResidualBlock(
          TransferPointResidual::CreateFull(point, {model.harmonic_ratio, false}), nullptr, u,
          &x[0], &x[1], &x[2], &x[3]);
    } else {
      problem.AddResidualBlock(TransferPointResidual::CreateReduced(point), nullptr, u, &x[0],
                               &x[1], &x[2]);
    }
  }
  problem.AddResidualBlock(QNoiseLevelPrior::Create(), nullptr, u);
  // Guard rails: a mode outside the points' band or without its N is another model.
  problem.SetParameterLowerBound(&x[1], 0, std::log(kTransferXiMin));
  problem.SetParameterUpperBound(&x[1], 0, std::log(kTransferXiMax));
  if (model.modes == 2) {
    if (band.cycle_frequency_hz > 0.0) {
      const double reach = 0.5 * std::log(model.harmonic_ratio);
      problem.SetParameterLowerBound(&x[0], 0, std::log(band.cycle_frequency_hz) - reach);
      problem.SetParameterUpperBound(&x[0], 0, std::log(band.cycle_frequency_hz) + reach);
    }
    problem.SetParameterLowerBound(&x[3], 0, x[2] + std::log(1e-6));
    problem.SetParameterUpperBound(&x[3], 0, x[2] + std::log(1e6));
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
  ceres::Problem::EvaluateOptions evaluate;
  for (int k = 0; k < (model.modes == 2 ? 4 : 3); ++k) {
    evaluate.parameter_blocks.push_back(&x[static_cast<std::size_t>(k)]);
  }
  evaluate.parameter_blocks.push_back(u);
  problem.GetResidualBlocks(&evaluate.residual_blocks);
  evaluate.residual_blocks.pop_back();  // the prior of u
  problem.Evaluate(evaluate, &solution.cost, &solution.misfits, nullptr, &jacobian);
  solution.jacobian = Eigen::MatrixXd::Zero(jacobian.num_rows, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    const auto r = static_cast<std::size_t>(row);
    for (int i = jacobian.rows[r]; i < jacobian.rows[r + 1]; ++i) {
      const auto k = static_cast<std::size_t>(i);
      solution.jacobian(row, jacobian.cols[k]) = jacobian.values[k];
    }
  }
  return solution;
}

// The points with a variance that is `factor` times as large, because overlapping neighbours share
// data.
void Widen(double factor, std::vector<TransferPoint>* points) {
  for (TransferPoint& point : *points) {
    point.variance_re *= factor;
    point.variance_im *= factor;
    point.covariance *= factor;
  }
}

// The model's own error, relative to the size of G about the point: to |H| itself it would be
// smallest where chance made |H| small.
std::vector<TransferPoint> WithModelError(std::span<const TransferPoint> points, double error) {
  constexpr std::size_t kReach = 4;  // points on either side
  std::vector<TransferPoint> result(points.begin(), points.end());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t first = k < kReach ? 0 : k - kReach;
    const std::size_t last = std::min(k + kReach + 1, points.size());
    double size = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      size += (points[i].re * points[i].re + points[i].im * points[i].im) /
              static_cast<double>(last - first);
    }
    result[k].variance_re += 0.5 * error * error * size;
    result[k].variance_im += 0.5 * error * error * size;
  }
  return result;
}

// See TransferFit.
double PointsPerError(std::span<const double> misfits) {
  const std::size_t points = misfits.size() / 2;
  const auto product = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 2 * (points - lag); ++i) sum += misfits[i] * misfits[i + 2 * lag];
    return sum / static_cast<double>(points - lag);
  };
  const double power = product(0);
  double sum = 1.0;
  for (std::size_t lag = 1; lag < points / 2 && power > 0.0; ++lag) {
    const double correlation = product(lag) / power;
    if (!(correlation > 0.0)) break;
    sum += 2.0 * correlation;
  }
  return sum;
}

// A parameter that the points do not determine has an infinite variance, and not, as in a
// pseudo-inverse, a variance of zero: the logarithm of a second mode of vanishing size is
// undetermined.
Eigen::MatrixXd CovarianceOf(const Eigen::MatrixXd& information) {
  constexpr double kLeast = 1e-300;
  constexpr double kSingular = 1e-12;  // of a correlation matrix
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(kLeast).cwiseSqrt().cwiseInverse();
  const SymmetricEigen eigen =
      EigenOfSymmetric(scale.asDiagonal() * information * scale.asDiagonal());
  const Eigen::MatrixXd scaled = scale.asDiagonal() * eigen.vectors;
  return scaled * eigen.values.cwiseMax(kSingular).cwiseInverse().asDiagonal() * scaled.transpose();
}

}  // namespace

TransferBand TransferBandOf(const ModelSpec& model, double frequency_hz) {
  constexpr double kLowest = 0.25;
  constexpr double kHighestOneMode = 2.0;         // halfway to the paper's next mode
  constexpr double kHighestTwoModes = 5.0 / 3.0;  // over the second mode's frequency
  const double highest =
      model.modes == 2 ? kHighestTwoModes * model.harmonic_ratio : kHighestOneMode;
  return {kLowest * frequency_hz, highest * frequency_hz, frequency_hz};
}

TransferFit FitTransfer(const Transfer& transfer, const ModelSpec& model, const TransferBand& band,
                        const std::optional<FirstModeCarries>& first) {
  CHECK(model.modes == 1 || model.modes == 2) << model.modes;
  const bool second_mode = model.modes == 2;
  TransferFit fit;
  std::vector<TransferPoint> points;
  std::copy_if(transfer.points.begin(), transfer.points.end(), std::back_inserter(points),
               [&](const TransferPoint& point) { return band.Contains(point.frequency_hz); });
  if (points.size() < 4) return fit;
  const int free = second_mode ? 4 : 3;
  const double dof = 2.0 * static_cast<double>(points.size()) - free;
  const double inflation = transfer.neighbour_inflation;
  const auto solve = [&](double error) {
    std::vector<TransferPoint> softened = WithModelError(points, error);
    Widen(inflation, &softened);
    return Solve(softened, model, band, GridStart(softened, model, band, first));
  };
  const auto per_dof = [&](const Solution& at) { return 2.0 * inflation * at.cost / dof; };
  Solution solution = solve(0.0);
  fit.chi_square_per_dof = per_dof(solution);
  if (fit.chi_square_per_dof > 1.5) {
    double low = 1e-3, high = 10.0;
    for (int i = 0; i < 12; ++i) {
      fit.model_error = std::sqrt(low * high);
      solution = solve(fit.model_error);
      (per_dof(solution) > 1.0 ? low : high) = fit.model_error;
    }
    fit.points_per_error = PointsPerError(solution.misfits);
  }
  const LogParameters& x = solution.x;
  fit.available = solution.usable;
  fit.acoustics = {std::exp(x[0]), std::exp(x[1]), std::exp(x[2]),
                   second_mode ? std::exp(x[3]) : 0.0, model.harmonic_ratio};
  // The points' own scatter averages out over them, but the level of q's noise does not, because it
  // is one for all of them. The points tell something of it too, by a form that holds to first
  // order in it, so that they move the estimate; its uncertainty stays that of its prior.
  const double scale = std::max(per_dof(solution), 1.0) * fit.points_per_error;
  const Eigen::MatrixXd of_parameters = solution.jacobian.leftCols(free);
  const Eigen::MatrixXd inverse = CovarianceOf(of_parameters.transpose() * of_parameters / scale);
  const Eigen::VectorXd moved =
      inverse * (of_parameters.transpose() * solution.jacobian.col(free)) / scale;
  fit.log_covariance.topLeftCorner(free, free) = inverse + moved * moved.transpose();
  const auto estimate = [&](int i) {
    const double value = std::exp(x[static_cast<std::size_t>(i)]);
    return Estimate{value, value * std::sqrt(fit.log_covariance(i, i))};
  };
  fit.omega_hz = estimate(0);
  fit.xi = estimate(1);
  fit.N = estimate(2);
  fit.M = second_mode ? estimate(3) : Estimate{0.0, 0.0};

  double power = 0, missed = 0, noise = 0, explained = 0;
  for (const TransferPoint& point : transfer.points) {
    const Complex<double> g =
        0.5 * (AcousticResponse(fit.acoustics, point.frequency_hz - point.spread_hz) +
               AcousticResponse(fit.acoustics, point.frequency_hz + point.spread_hz));
    const Eigen::Vector2d error(g.re - point.re, g.im - point.im);
    const double misfit = std::sqrt(error.dot(point.TotalCovariance().ldlt().solve(error)));
    const double size = point.re * point.re + point.im * point.im;
    fit.points.push_back({point.frequency_hz, g.re, g.im, misfit,
                          std::sqrt(error.squaredNorm() / size),
                          band.Contains(point.frequency_hz)});
    power += point.weight;
    missed += point.weight * error.squaredNorm() / size;
    noise += point.weight * point.TotalCovariance().trace() / size;
    explained += misfit * misfit < 5.991 ? 1.0 : 0.0;  // chi-square, two degrees, 95 %
  }
  fit.explained_power = 1.0 - missed / power;
  fit.noise_power = noise / power;
  fit.points_within_95 = explained / static_cast<double>(transfer.points.size());
  return fit;
}

}  // namespace howl
