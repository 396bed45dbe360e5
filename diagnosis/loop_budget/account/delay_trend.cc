#include "diagnosis/loop_budget/account/delay_trend.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "estimation/analysis/spectra/half_width.h"

namespace howl {
namespace {

// Of scatter and trend, of ln tau.
constexpr double kLeast = 1e-4;
constexpr double kMost = 1.0;
// Six steps a decade: the density of a few points changes little over a third of a decade.
constexpr int kSteps = 24;
// Of ln tau at all points: of no weight beside what they tell.
constexpr double kMeanDeviation = 1.0;
// A record that tells of its delay less than a hundredth of what the prior does tells nothing.
constexpr double kLeastTold = 0.01;

double OfStep(int i) { return kLeast * std::pow(kMost / kLeast, i / double{kSteps}); }

// Adds exp(b) to exp(a), in logarithms.
double LogSum(double a, double b) {
  const double most = std::max(a, b);
  return std::isinf(most) ? most : most + std::log1p(std::exp(std::min(a, b) - most));
}

struct Grid {
  double log_density = -std::numeric_limits<double>::infinity();
  double trend = 0.0;   // of b: mean
  double square = 0.0;  // and mean square
};

class Delays {
 public:
  explicit Delays(const std::vector<TimedPoint>& points) {
    const auto size = static_cast<Eigen::Index>(points.size());
    x_.resize(size, 2);
    log_tau_.resize(size);
    variance_.resize(size);
    shared_.resize(size, points.empty() ? 0 : static_cast<Eigen::Index>(points[0].shared.size()));
    for (Eigen::Index e = 0; e < size; ++e) {
      const TimedPoint& point = points[static_cast<std::size_t>(e)];
      x_.row(e) << 1.0, point.z;
      log_tau_[e] = point.log_tau;
      variance_[e] = point.variance;
      for (Eigen::Index k = 0; k < shared_.cols(); ++k) {
        shared_(e, k) = point.shared[static_cast<std::size_t>(k)];
      }
    }
  }

  // Over all scatters; without a trend, or over all sizes of one.
  Grid Over(bool with_trend) const {
    Grid out;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= (with_trend ? kSteps : 0); ++j) {
        Add(OfStep(i), with_trend ? OfStep(j) : 0.0, &out);
      }
    }
    const int cells = (kSteps + 1) * (with_trend ? kSteps + 1 : 1);
    out.log_density -= std::log(cells);
    return out;
  }

 private:
  // One cell of the grid.
  void Add(double scatter, double trend_deviation, Grid* out) const {
    const Eigen::Vector2d prior(kMeanDeviation * kMeanDeviation, trend_deviation * trend_deviation);
    Eigen::MatrixXd covariance = x_ * prior.asDiagonal() * x_.transpose();
    covariance += shared_ * shared_.transpose();
    covariance.diagonal().array() += variance_.array() + scatter * scatter;
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    const Eigen::VectorXd weighed = factor.solve(log_tau_);
    const double log_determinant = 2.0 * factor.matrixLLT().diagonal().array().log().sum();
    const double log_density =
        -0.5 * (log_tau_.dot(weighed) + log_determinant +
                static_cast<double>(log_tau_.size()) * std::log(2.0 * std::numbers::pi));
    const Eigen::VectorXd z = x_.col(1);
    const double trend = prior[1] * z.dot(weighed);
    const double variance = prior[1] - prior[1] * prior[1] * z.dot(factor.solve(z));
    const double sum = LogSum(out->log_density, log_density);
    const double share = std::exp(log_density - sum);
    out->trend += share * (trend - out->trend);
    out->square += share * (variance + trend * trend - out->square);
    out->log_density = sum;
  }

  Eigen::MatrixX2d x_;
  Eigen::VectorXd log_tau_;
  Eigen::VectorXd variance_;
  Eigen::MatrixXd shared_;
};

// None of a point whose record tells nothing of its delay.
std::vector<std::optional<TimedPoint>> ToldDelays(const LoopRecords& records, const LoopFit& fit) {
  std::vector<std::optional<TimedPoint>> out(records.size());
  const Eigen::Index delay = fit.model.structure.Delay();
  for (std::size_t e = 0; e < records.size(); ++e) {
    const PointFit& point = fit.fit.points[e];
    const PointPrior prior = fit.fit.prior[e].NormalAt(point.parameters);
    const double of_prior = 1.0 / std::pow(prior.deviation[delay], 2);
    // Of this parameter alone, the prior's part can be taken from what is left when all others are
    // integrated over.
    const double precision = 1.0 / point.Covariance()(delay, delay) - of_prior;
    if (!(precision > kLeastTold * of_prior)) continue;
    const double told =
        ((precision + of_prior) * point.parameters[delay] - of_prior * prior.mean[delay]) /
        precision;
    // A point's delay is in radians of its cycle (loop_point.h), with what effects add to it.
    const double cycle_hz = records.cycle_hz()[e];
    const double of_cycle = std::exp(told);
    const double tau = of_cycle - TurnOfCycle(fit.model.effects, cycle_hz);
    if (!(tau > 0.0)) continue;
    out[e] = {fit.fit.z[e], std::log(tau / (2.0 * std::numbers::pi * cycle_hz)),
              std::pow(of_cycle / tau, 2) / precision};
  }
  return out;
}

}  // namespace

std::vector<TimedPoint> DelaysOf(const LoopRecords& records, const LoopFit& fit,
                                 const std::vector<SharedErrors>& shared,
                                 const LoopBudgetOptions& options) {
  std::vector<std::optional<TimedPoint>> all = ToldDelays(records, fit);
  for (std::size_t k = 0; k < shared.size(); ++k) {
    for (std::size_t j = 0; j < shared[k].deviations.size(); ++j) {
      LoopForm moved = fit.model;
      const auto at = std::ranges::find(moved.effects, shared[k].effect, &SharedEffect::effect);
      CHECK(at != moved.effects.end());
      at->values[j] += shared[k].deviations[j];
      const std::string key = "delays/" + std::to_string(k) + "/" + std::to_string(j) + "/";
      const std::vector<std::optional<TimedPoint>> other = ToldDelays(
          records,
          FitLoopFrom(records, moved, {ParametersOf(fit)}, MaximumTaken::kNext, key, options));
      for (std::size_t e = 0; e < all.size(); ++e) {
        if (!all[e]) continue;
        all[e]->shared.push_back(other[e] ? other[e]->log_tau - all[e]->log_tau : 0.0);
      }
    }
  }
  std::vector<TimedPoint> out;
  for (std::optional<TimedPoint>& each : all) {
    if (each) out.push_back(std::move(*each));
  }
  return out;
}

DelayTrend TrendOf(const std::vector<TimedPoint>& points) {
  DelayTrend out;
  if (points.size() < kFewestOfTrend) return out;
  std::vector<TimedPoint> about = points;
  double mean = 0.0;
  for (const TimedPoint& each : points) mean += each.log_tau / static_cast<double>(points.size());
  for (TimedPoint& each : about) each.log_tau -= mean;
  const Grid with = Delays(about).Over(true);
  const double without = Delays(about).Over(false).log_density;
  for (std::size_t e = 0; e < about.size(); ++e) {
    std::vector<TimedPoint> others = about;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(e));
    const Delays left(others);
    const double better =
        (with.log_density - left.Over(true).log_density) - (without - left.Over(false).log_density);
    out.nats += better;
    if (better > 0.0) ++out.points_better;
  }
  const auto [least, most] = std::ranges::minmax(about, {}, &TimedPoint::z);
  const double span = most.z - least.z;
  const double deviation = std::sqrt(std::max(with.square - with.trend * with.trend, 0.0));
  out.rel_span = span * with.trend;
  out.low = out.rel_span - HalfWidth95(span * deviation);
  out.high = out.rel_span + HalfWidth95(span * deviation);
  return out;
}

}  // namespace howl
