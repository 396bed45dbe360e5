#include "diagnosis/fit/delay_scatter.h"

#include <algorithm>
#include <cmath>

namespace howl {
namespace {

// The least width that is tried, below which records seldom tell one delay from another.
constexpr double kLeast = 1e-5;
constexpr double kMost = 1.0;  // some delays are thrice as long as others
constexpr double kStep = 1.02;

// The mean by the likelihood of the optima alone, which are normal about it with the variance
// s^2 + 1 / I_e.
double MeanAt(const std::vector<OwnDelay>& delays, double s) {
  double sum = 0.0;
  double weights = 0.0;
  for (const OwnDelay& delay : delays) {
    const double weight = delay.information / (1.0 + s * s * delay.information);
    sum += weight * delay.optimum;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

double CostAt(const std::vector<OwnDelay>& delays, double mean, double s) {
  double cost = 0.0;
  for (const OwnDelay& delay : delays) {
    const double spread = 1.0 + s * s * delay.information;
    const double off = delay.optimum - mean;
    cost += 0.5 * (std::log(spread) + off * off * delay.information / spread);
  }
  return cost;
}

}  // namespace

double DelayPrice(double log_delay, double standard_deviation) {
  if (standard_deviation == 0.0) return 0.0;
  const double off = log_delay / standard_deviation;
  return 0.5 * off * off;
}

double FreedomCost(const std::vector<OwnDelay>& delays, double standard_deviation) {
  double cost = 0.0;
  for (const OwnDelay& delay : delays) {
    cost += 0.5 * std::log1p(standard_deviation * standard_deviation * delay.information);
  }
  return cost;
}

double UnearnedFreedom(double cost_without, double cost_with, std::size_t experiments,
                       std::size_t parameters) {
  const double share = static_cast<double>(1 + parameters) /
                       static_cast<double>(std::max<std::size_t>(experiments, 1));
  return std::min(share, 1.0) * std::max(cost_without - cost_with, 0.0);
}

double ScatterCost(const std::vector<OwnDelay>& delays, double standard_deviation) {
  double cost = FreedomCost(delays, standard_deviation);
  for (const OwnDelay& delay : delays) cost += DelayPrice(delay.log_delay, standard_deviation);
  return cost;
}

DelayScatter FitScatter(const std::vector<OwnDelay>& delays) {
  DelayScatter best{MeanAt(delays, 0.0), 0.0};
  if (delays.size() < 2) return best;
  double least = CostAt(delays, best.mean, 0.0);
  const auto look = [&](double s) {
    const double mean = MeanAt(delays, s);
    const double cost = CostAt(delays, mean, s);
    if (cost < least) {
      least = cost;
      best = {mean, s};
    }
  };
  for (double s = kLeast; s < kMost; s *= kStep) look(s);
  return best;
}

double ShrunkenDelay(const OwnDelay& delay, const DelayScatter& scatter) {
  const double power = scatter.standard_deviation * scatter.standard_deviation * delay.information;
  return (delay.optimum - scatter.mean) * power / (1.0 + power);
}

}  // namespace howl
