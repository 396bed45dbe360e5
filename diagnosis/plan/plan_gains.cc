#include "diagnosis/plan/plan_gains.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/fit/delay_scatter.h"

namespace howl {

PointProducts ProductsOf(const PlanPoint& point, const std::vector<EffectLine>& lines,
                         const std::vector<PlanEntry>& entries, double scale) {
  const Eigen::VectorXd& delay = point.delay();
  const auto count = static_cast<Eigen::Index>(entries.size());
  Eigen::MatrixXd changes(delay.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const PlanEntry& entry = entries[static_cast<std::size_t>(i)];
    const EffectLine& line = lines[entry.line];
    changes.col(i) = point.Change(*line.effect, line.ValuesAt(entry.size));
  }
  PointProducts out;
  out.changes = Eigen::MatrixXd::Zero(count, count);
  out.changes.selfadjointView<Eigen::Lower>().rankUpdate(changes.transpose(), scale);
  out.changes.triangularView<Eigen::StrictlyUpper>() = out.changes.transpose();
  out.with_delay = scale * (changes.transpose() * delay);
  out.delay = scale * delay.squaredNorm();
  return out;
}

PointProducts SquaresOf(const PlanPoint& point, const std::vector<EffectLine>& lines,
                        const std::vector<PlanEntry>& entries, double scale) {
  const auto count = static_cast<Eigen::Index>(entries.size());
  PointProducts out;
  out.changes = Eigen::MatrixXd::Zero(count, count);
  out.with_delay.resize(count);
  out.delay = scale * point.delay().squaredNorm();
  for (Eigen::Index i = 0; i < count; ++i) {
    const PlanEntry& entry = entries[static_cast<std::size_t>(i)];
    const EffectLine& line = lines[entry.line];
    const Eigen::VectorXd change = point.Change(*line.effect, line.ValuesAt(entry.size));
    out.changes(i, i) = scale * change.squaredNorm();
    out.with_delay[i] = scale * change.dot(point.delay());
  }
  return out;
}

namespace {

// The cost of delays that scatter about their mean by so much (delay_scatter.h).
double CostOf(const std::vector<OwnDelay>& delays, const DelayScatter& scatter) {
  const double s = scatter.standard_deviation;
  double cost = FreedomCost(delays, s);
  for (const OwnDelay& delay : delays) {
    const double off = delay.optimum - scatter.mean;
    cost += 0.5 * off * off * delay.information / (1.0 + s * s * delay.information);
  }
  return cost;
}

}  // namespace

PlanGains::PlanGains(std::vector<PointProducts> points, std::vector<double> log_delays)
    : points_(std::move(points)), log_delays_(std::move(log_delays)) {}

std::vector<OwnDelay> PlanGains::Delays(std::size_t i, double factor) const {
  std::vector<OwnDelay> delays;
  for (std::size_t e = 0; e < points_.size(); ++e) {
    const PointProducts& point = points_[e];
    const double moved =
        point.delay > 0.0 ? point.with_delay[static_cast<Eigen::Index>(i)] / point.delay : 0.0;
    delays.push_back({0.0, log_delays_[e] + factor * moved, 2.0 * point.delay});
  }
  return delays;
}

double PlanGains::ScatterOf(std::size_t i) const {
  return log_delays_.empty() ? 0.0 : FitScatter(Delays(i, 1.0)).standard_deviation;
}

// With own delays of standard deviation s, an experiment's product with the delay is worth
// 1 / (1 + s^2 I) of itself, I being its information on the delay.
double PlanGains::Product(std::size_t i, std::size_t j, double scatter) const {
  const auto a = static_cast<Eigen::Index>(i);
  const auto b = static_cast<Eigen::Index>(j);
  const double freedom = 2.0 * scatter * scatter;
  double sum = 0.0;
  double with_a = 0.0;
  double with_b = 0.0;
  double delay = 0.0;
  for (const PointProducts& point : points_) {
    const double share = 1.0 / (1.0 + freedom * point.delay);
    sum += point.changes(a, b) - freedom * share * point.with_delay[a] * point.with_delay[b];
    with_a += share * point.with_delay[a];
    with_b += share * point.with_delay[b];
    delay += share * point.delay;
  }
  return delay > 0.0 ? sum - with_a * with_b / delay : sum;
}

double PlanGains::Gain(std::size_t i, std::size_t parameters) const {
  if (log_delays_.empty()) return std::max(Product(i, i, 0.0), 0.0);
  const auto a = static_cast<Eigen::Index>(i);
  double beside_delays = 0.0;
  for (const PointProducts& point : points_) {
    beside_delays += point.changes(a, a);
    if (point.delay > 0.0) beside_delays -= std::pow(point.with_delay[a], 2) / point.delay;
  }
  // Without the effect the delays scatter by more, which has its price (delay_scatter.h).
  const std::vector<OwnDelay> without = Delays(i, 1.0);
  const std::vector<OwnDelay> with = Delays(i, 0.0);
  const DelayScatter wide = FitScatter(without);
  const DelayScatter narrow = FitScatter(with);
  const double unearned =
      UnearnedFreedom(FreedomCost(without, wide.standard_deviation),
                      FreedomCost(with, narrow.standard_deviation), points_.size(), parameters);
  return std::max(beside_delays + CostOf(without, wide) - CostOf(with, narrow) - unearned, 0.0);
}

}  // namespace howl
