#include "trial/power.h"

#include <algorithm>
#include <cmath>

#include "trial/score.h"

namespace howl {
namespace {

constexpr double kLapse = 0.01;
constexpr double kWanted = 0.9;
constexpr double kSmallest = 0.1;  // severities of a trial
constexpr double kLargest = 1.0;
constexpr double kResolvedWidth = 0.3;  // from small to medium
constexpr int kThresholds = 301;
constexpr double kLowestThreshold = -0.75;
constexpr double kHighestThreshold = 1.75;
constexpr int kWidths = 24;
constexpr double kNarrowest = 0.01;
constexpr double kWidest = 0.25;

struct Trial {
  double severity;
  bool found;
};

double Threshold(int i) {
  return kLowestThreshold + (kHighestThreshold - kLowestThreshold) * i / (kThresholds - 1);
}
double Width(int j) { return kNarrowest * std::pow(kWidest / kNarrowest, j / (kWidths - 1.0)); }

// The likelihood of the effect's cases at each threshold.
std::vector<double> Likelihood(const std::vector<Trial>& trials, double width) {
  std::vector<double> out(kThresholds, 1.0);
  for (int i = 0; i < kThresholds; ++i) {
    for (const Trial& trial : trials) {
      const double p = (1.0 - kLapse) / (1.0 + std::exp(-(trial.severity - Threshold(i)) / width));
      out[static_cast<std::size_t>(i)] *= trial.found ? p : 1.0 - p;
    }
  }
  return out;
}

double Sum(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum;
}

double Quantile(std::vector<std::pair<double, double>>& weighted, double share) {
  double total = 0.0;
  for (const auto& [value, weight] : weighted) total += weight;
  double sum = 0.0;
  for (const auto& [value, weight] : weighted) {
    sum += weight;
    if (sum >= share * total) return value;
  }
  return weighted.back().first;
}

}  // namespace

std::vector<EffectPower> ComputePower(std::span<const CaseOutcome> cases,
                                      std::span<const RigEffect> effects) {
  std::vector<EffectPower> out;
  std::vector<std::vector<Trial>> trials;
  for (const RigEffect& effect : effects) {
    std::vector<Trial> own;
    EffectPower power;
    for (const CaseOutcome& one : cases) {
      if (one.Truth() != TruthKind::kCatalogue || one.withheld[0].id != effect.id) continue;
      const bool found = IsInClass(one);
      own.push_back({one.Severity(), found});
      ++power.cases;
      power.found += found ? 1 : 0;
    }
    if (own.empty()) continue;
    power.effect = effect.id;
    power.size_name = effect.size_name;
    out.push_back(std::move(power));
    trials.push_back(std::move(own));
  }
  // The posterior of the width: the product over effects of the likelihood that is left when each
  // effect's threshold is summed over.
  std::vector<double> log_width(kWidths, 0.0);
  for (int j = 0; j < kWidths; ++j) {
    for (const std::vector<Trial>& own : trials) {
      log_width[static_cast<std::size_t>(j)] += std::log(Sum(Likelihood(own, Width(j))));
    }
  }
  const double best = log_width.empty() ? 0.0 : *std::ranges::max_element(log_width);
  for (std::size_t e = 0; e < out.size(); ++e) {
    std::vector<std::pair<double, double>> weighted;
    for (int j = 0; j < kWidths; ++j) {
      const std::vector<double> likelihood = Likelihood(trials[e], Width(j));
      const double weight =
          std::exp(log_width[static_cast<std::size_t>(j)] - best) / Sum(likelihood);
      // (1 - lapse) / (1 + exp(-d / width)) = 0.9
      const double above = -Width(j) * std::log((1.0 - kLapse) / kWanted - 1.0);
      for (int i = 0; i < kThresholds; ++i) {
        weighted.emplace_back(Threshold(i) + above,
                              weight * likelihood[static_cast<std::size_t>(i)]);
      }
    }
    std::ranges::sort(weighted);
    EffectPower& power = out[e];
    power.severity = Quantile(weighted, 0.5);
    power.severity_low = Quantile(weighted, 0.05);
    power.severity_high = Quantile(weighted, 0.95);
    power.resolved = power.severity_high - power.severity_low <= kResolvedWidth;
    const RigEffect& effect = *std::ranges::find(effects, power.effect, &RigEffect::id);
    power.size = SizeAtSeverity(effect, power.severity);
    power.size_low = SizeAtSeverity(effect, power.severity_low);
    power.size_high = SizeAtSeverity(effect, power.severity_high);
  }
  return out;
}

std::string_view BeyondTried(double severity) {
  if (severity > kLargest) return "beyond large";
  return severity < kSmallest ? "below small" : "";
}

}  // namespace howl
