#include "diagnosis/samples/fluctuation_kind.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace howl {
namespace {

constexpr int kTerms = 3;  // 1, u, u^2
constexpr double kColouredParameters = 2.0;
constexpr double kSwitchingParameters = 4.0;
constexpr double kLeastStd = 0.005;  // of the grid, up to 1.5
constexpr int kStds = 20;
constexpr int kExpectations = 60;
// Variance in addition to the noise: with more than this the two levels are not constant levels.
constexpr double kMostExcess = 0.04;
constexpr double kLargestDrop = 0.99;
constexpr double kLargestLeave = 0.6;
constexpr double kLeastLeave = 2e-3;
constexpr double kThroughTransit = 0.5;  // of the jumps, those that a window catches half way

enum State : std::size_t { kLow, kHigh, kTransit, kStates };
using PerState = std::array<double, kStates>;

Eigen::MatrixXd Columns(const GainSeries& series) {
  const auto n = static_cast<Eigen::Index>(series.amplitude.size());
  const Eigen::Map<const Eigen::ArrayXd> amplitude(series.amplitude.data(), n);
  const Eigen::ArrayXd u = amplitude - amplitude.mean();
  Eigen::MatrixXd out(n, kTerms);
  out.col(0).setOnes();
  out.col(1) = u;
  out.col(2) = u.square();
  return out;
}

Eigen::VectorXd LeastSquares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y) {
  Eigen::MatrixXd gram = columns.transpose() * columns;
  gram.diagonal() *= 1.0 + 1e-9;
  gram.diagonal().array() += 1e-12;
  return gram.ldlt().solve(columns.transpose() * y);
}

// Minus the log-likelihood of one experiment at the best regression: the Kalman filter whitens y
// and the columns alike.
double ColouredCost(const GainSeries& series, const Eigen::MatrixXd& columns, double a,
                    double variance) {
  const Eigen::Index n = columns.rows();
  Eigen::MatrixXd table(n, kTerms + 1);
  table.leftCols(kTerms) = columns;
  for (Eigen::Index i = 0; i < n; ++i) {
    table(i, kTerms) = series.gain[static_cast<std::size_t>(i)];
  }
  Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(kTerms + 1);
  double spread = variance;
  double logs = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double total = spread + series.variance[static_cast<std::size_t>(i)];
    const Eigen::RowVectorXd innovation = table.row(i) - state;
    const double gain = spread / total;
    state = a * (state + gain * innovation);
    spread = a * a * spread * (1.0 - gain) + variance * (1.0 - a * a);
    logs += std::log(total);
    table.row(i) = innovation / std::sqrt(total);
  }
  const Eigen::VectorXd b = LeastSquares(table.leftCols(kTerms), table.col(kTerms));
  const double squares = (table.col(kTerms) - table.leftCols(kTerms) * b).squaredNorm();
  return 0.5 * (logs + squares + static_cast<double>(n) * std::log(2.0 * std::numbers::pi));
}

double Normal(double x, double variance) {
  return std::exp(-0.5 * x * x / variance) / std::sqrt(2.0 * std::numbers::pi * variance);
}

// The two-level model by expectation maximisation.
class Switcher {
 public:
  Switcher(const std::vector<GainSeries>& experiments, double drop)
      : experiments_(experiments), drop_(drop) {
    for (const GainSeries& series : experiments) {
      columns_.push_back(Columns(series));
      const Eigen::Map<const Eigen::VectorXd> y(series.gain.data(), columns_.back().rows());
      Eigen::VectorXd b = Eigen::VectorXd::Zero(kTerms);
      // The start has half the time on either level.
      b[0] = y.mean() / (1.0 - 0.5 * drop);
      coefficients_.push_back(b);
      excess_ += 0.05 * drop * drop / static_cast<double>(experiments.size());
    }
  }

  SwitchingFluctuation Fit() {
    SwitchingFluctuation best;
    best.cost = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kExpectations; ++i) {
      const double cost = Step();
      if (cost < best.cost) best = {cost, now_.drop, now_.leave_low_per_step};
    }
    best.cost += kSwitchingParameters;
    return best;
  }

 private:
  double Level(std::size_t state) const {
    return state == kLow ? 1.0 - drop_ : state == kHigh ? 1.0 : 1.0 - 0.5 * drop_;
  }
  double Spread(std::size_t state, double noise) const {
    return noise + excess_ + (state == kTransit ? drop_ * drop_ / 12.0 : 0.0);
  }
  double Move(std::size_t from, std::size_t to) const {
    if (from == kTransit) return to == kTransit ? 0.0 : 0.5;
    if (from == to) return 1.0 - leave_[from];
    return leave_[from] * (to == kTransit ? kThroughTransit : 1.0 - kThroughTransit);
  }

  // One step of expectation and maximisation; returns the cost before it.
  double Step() {
    now_.drop = drop_;
    now_.leave_low_per_step = leave_[kLow];
    double cost = 0.0;
    std::array<double, 2> left{};
    std::array<double, 2> stayed{};
    double drop_up = 0.0;
    double drop_down = 0.0;
    double excess_up = 0.0;
    double excess_down = 0.0;
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
      const GainSeries& series = experiments_[e];
      const Eigen::MatrixXd& columns = columns_[e];
      const auto n = static_cast<std::size_t>(columns.rows());
      const Eigen::Map<const Eigen::VectorXd> y(series.gain.data(), columns.rows());
      const Eigen::VectorXd upper = columns * coefficients_[e];
      std::vector<PerState> emitted(n);
      std::vector<PerState> forward(n);
      std::vector<double> scale(n);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t s = 0; s < kStates; ++s) {
          const auto at = static_cast<Eigen::Index>(i);
          emitted[i][s] =
              Normal(y[at] - Level(s) * upper[at], Spread(s, series.variance[i])) + 1e-300;
          double before = s == kTransit ? 0.0 : 0.5;
          if (i > 0) {
            before = 0.0;
            for (std::size_t r = 0; r < kStates; ++r) before += forward[i - 1][r] * Move(r, s);
          }
          forward[i][s] = before * emitted[i][s];
        }
        scale[i] = forward[i][kLow] + forward[i][kHigh] + forward[i][kTransit];
        for (double& value : forward[i]) value /= scale[i];
        cost -= std::log(scale[i]);
      }
      PerState backward = {1.0, 1.0, 1.0};
      Eigen::VectorXd weight(columns.rows());
      Eigen::VectorXd target(columns.rows());
      for (std::size_t i = n; i-- > 0;) {
        const auto at = static_cast<Eigen::Index>(i);
        double weights = 0.0;
        double targets = 0.0;
        for (std::size_t s = 0; s < kStates; ++s) {
          const double share = forward[i][s] * backward[s];
          const double w = share / Spread(s, series.variance[i]);
          weights += w * Level(s) * Level(s);
          targets += w * Level(s) * y[at];
          const double off = y[at] - Level(s) * upper[at];
          if (s == kLow) {
            drop_up += w * upper[at] * (upper[at] - y[at]);
            drop_down += w * upper[at] * upper[at];
          }
          if (s != kTransit) {
            excess_up += share * (off * off - series.variance[i]);
            excess_down += share;
          }
        }
        weight[at] = std::sqrt(std::max(weights, 1e-300));
        target[at] = targets / weight[at];
        if (i == 0) break;
        PerState next{};
        for (std::size_t r = 0; r < kStates; ++r) {
          for (std::size_t s = 0; s < kStates; ++s) {
            const double way = Move(r, s) * emitted[i][s] * backward[s] / scale[i];
            next[r] += way;
            if (r != kTransit) (r == s ? stayed : left)[r] += forward[i - 1][r] * way;
          }
        }
        backward = next;
      }
      coefficients_[e] = LeastSquares(weight.asDiagonal() * columns, target);
    }
    drop_ = std::clamp(drop_up / std::max(drop_down, 1e-300), 1e-3, kLargestDrop);
    excess_ = std::clamp(excess_up / std::max(excess_down, 1e-300), 1e-4 * drop_ * drop_,
                         kMostExcess * drop_ * drop_);
    for (const std::size_t s : {kLow, kHigh}) {
      leave_[s] =
          std::clamp(left[s] / std::max(left[s] + stayed[s], 1e-300), kLeastLeave, kLargestLeave);
    }
    return cost;
  }

  const std::vector<GainSeries>& experiments_;
  std::vector<Eigen::MatrixXd> columns_;
  std::vector<Eigen::VectorXd> coefficients_;
  double drop_;
  double excess_ = 0.0;  // variance in addition to the noise
  std::array<double, 2> leave_ = {0.15, 0.15};
  SwitchingFluctuation now_;
};

}  // namespace

ColouredFluctuation FitColoured(const std::vector<GainSeries>& experiments) {
  std::vector<Eigen::MatrixXd> columns;
  for (const GainSeries& series : experiments) columns.push_back(Columns(series));
  ColouredFluctuation best;
  best.cost = std::numeric_limits<double>::infinity();
  const auto attempt = [&](double a, double std) {
    double cost = kColouredParameters;
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      cost += ColouredCost(experiments[e], columns[e], a, std * std);
    }
    if (cost < best.cost) best = {cost, std, a};
  };
  for (const double a : {0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.88, 0.94, 0.97, 0.99}) {
    double std = kLeastStd;
    for (int i = 0; i < kStds; ++i) {
      attempt(a, std);
      std *= 1.35;
    }
  }
  for (double part : {0.5, 0.25, 0.12}) {
    const ColouredFluctuation at = best;
    for (const double up : {-1.0, 0.0, 1.0}) {
      for (const double wide : {-1.0, 0.0, 1.0}) {
        attempt(std::clamp(at.step_correlation + 0.1 * up * part, 0.0, 0.995),
                at.std * std::pow(1.35, wide * part));
      }
    }
  }
  return best;
}

SwitchingFluctuation FitSwitching(const std::vector<GainSeries>& experiments) {
  SwitchingFluctuation best;
  best.cost = std::numeric_limits<double>::infinity();
  for (const double drop : {0.05, 0.15, 0.3, 0.5, 0.75}) {
    const SwitchingFluctuation found = Switcher(experiments, drop).Fit();
    if (found.cost < best.cost) best = found;
  }
  return best;
}

}  // namespace howl
