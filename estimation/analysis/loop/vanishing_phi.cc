#include "estimation/analysis/loop/vanishing_phi.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/numerics/units.h"

namespace howl {

VanishingPhi EstimateVanishingPhi(std::span<const LoopGainPoint> points) {
  VanishingPhi result;
  const double n = static_cast<double>(points.size());
  const bool weighted = std::all_of(points.begin(), points.end(), [](const LoopGainPoint& p) {
    return std::isfinite(p.loop_gain.std) && p.loop_gain.std > 0.0;
  });
  if (points.size() < 3) return result;
  const auto weight = [&](const LoopGainPoint& p) {
    return weighted ? 1.0 / (p.loop_gain.std * p.loop_gain.std) : 1.0;
  };
  double total = 0, phi_mean = 0, gain_mean = 0;
  for (const LoopGainPoint& p : points) {
    total += weight(p);
    phi_mean += weight(p) * p.phi;
    gain_mean += weight(p) * p.loop_gain.value;
  }
  phi_mean /= total;
  gain_mean /= total;
  double sxx = 0, sxy = 0;
  for (const LoopGainPoint& p : points) {
    sxx += weight(p) * (p.phi - phi_mean) * (p.phi - phi_mean);
    sxy += weight(p) * (p.phi - phi_mean) * (p.loop_gain.value - gain_mean);
  }
  if (!(sxx > 1e-12 * total)) return result;
  const double slope = sxy / sxx;
  double chi_square = 0;
  for (const LoopGainPoint& p : points) {
    const double r = p.loop_gain.value - gain_mean - slope * (p.phi - phi_mean);
    chi_square += weight(p) * r * r;
  }
  const double scatter = chi_square / (n - 2.0);
  const double scale = weighted ? std::max(scatter, 1.0) : scatter;
  const double t = kNormal95 * (weighted && scatter <= 1.0 ? 1.0 : StudentInflation(n - 2.0));
  result.available = true;
  result.slope = slope;
  result.intercept = gain_mean - slope * phi_mean;
  result.phi = (1.0 - result.intercept) / slope;

  // With u = phi - phi_mean and d = gain_mean - 1: (d + slope u)^2 <= t^2 scale (1/total +
  // u^2/sxx).
  const double d = gain_mean - 1.0;
  const double a = slope * slope - t * t * scale / sxx;
  const double b = d * slope;
  const double c = d * d - t * t * scale / total;
  const double discriminant = b * b - a * c;
  if (a > 0.0 && discriminant >= 0.0) {
    result.lo = phi_mean + (-b - std::sqrt(discriminant)) / a;
    result.hi = phi_mean + (-b + std::sqrt(discriminant)) / a;
  }
  return result;
}

VanishingPhi EstimateVanishingPhi(std::span<const Experiment> experiments) {
  std::vector<LoopGainPoint> points;
  for (const Experiment& experiment : experiments) {
    if (!experiment.reliable || !experiment.flame_slope) continue;
    LoopGainPoint point;
    point.phi = experiment.phi;
    point.loop_gain.value = experiment.gain * kRadPerSPerHz * experiment.frequency_hz *
                            std::abs(*experiment.flame_slope);
    if (experiment.gain_std && experiment.flame_slope_std) {
      point.loop_gain.std =
          point.loop_gain.value * std::hypot(*experiment.gain_std / experiment.gain,
                                             *experiment.flame_slope_std / *experiment.flame_slope);
    }
    points.push_back(point);
  }
  return EstimateVanishingPhi(points);
}

}  // namespace howl
