#include "estimation/analysis/loop/vanishing_phi.h"

#include <cmath>
#include <optional>
#include <vector>

#include "estimation/analysis/loop/straight_line.h"
#include "model/numerics/units.h"

namespace howl {

VanishingPhi EstimateVanishingPhi(std::span<const LoopGainPoint> points) {
  VanishingPhi result;
  std::vector<LinePoint> gains;
  for (const LoopGainPoint& point : points) gains.push_back({point.phi, point.loop_gain});
  const std::optional<StraightLine> line = FitStraightLine(gains);
  if (!line) return result;
  const double slope = line->slope;
  result.available = true;
  result.slope = slope;
  result.intercept = line->y_mean - slope * line->x_mean;
  result.phi = (1.0 - result.intercept) / slope;

  // With u = phi - phi_mean and d = gain_mean - 1: (d + slope u)^2 <= t^2 scale (1/weight +
  // u^2/sxx).
  const double t = line->t;
  const double d = line->y_mean - 1.0;
  const double a = slope * slope - t * t * line->scale / line->sxx;
  const double b = d * slope;
  const double c = d * d - t * t * line->scale / line->weight;
  const double discriminant = b * b - a * c;
  if (a > 0.0 && discriminant >= 0.0) {
    result.lo = line->x_mean + (-b - std::sqrt(discriminant)) / a;
    result.hi = line->x_mean + (-b + std::sqrt(discriminant)) / a;
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
