#include "estimation/analysis/loop/straight_line.h"

#include <algorithm>
#include <cmath>

namespace howl {

std::optional<StraightLine> FitStraightLine(std::span<const LinePoint> points) {
  const double n = static_cast<double>(points.size());
  const bool weighted = std::all_of(points.begin(), points.end(), [](const LinePoint& p) {
    return std::isfinite(p.y.std) && p.y.std > 0.0;
  });
  if (points.size() < 3) return std::nullopt;
  const auto weight = [&](const LinePoint& p) {
    return weighted ? 1.0 / (p.y.std * p.y.std) : 1.0;
  };
  StraightLine line;
  for (const LinePoint& p : points) {
    line.weight += weight(p);
    line.x_mean += weight(p) * p.x;
    line.y_mean += weight(p) * p.y.value;
  }
  line.x_mean /= line.weight;
  line.y_mean /= line.weight;
  double sxy = 0;
  for (const LinePoint& p : points) {
    line.sxx += weight(p) * (p.x - line.x_mean) * (p.x - line.x_mean);
    sxy += weight(p) * (p.x - line.x_mean) * (p.y.value - line.y_mean);
  }
  if (!(line.sxx > 1e-12 * line.weight)) return std::nullopt;
  line.slope = sxy / line.sxx;
  double chi_square = 0;
  for (const LinePoint& p : points) {
    const double r = p.y.value - line.y_mean - line.slope * (p.x - line.x_mean);
    chi_square += weight(p) * r * r;
  }
  const double scatter = chi_square / (n - 2.0);
  line.scale = weighted ? std::max(scatter, 1.0) : scatter;
  line.t = kNormal95 * (weighted && scatter <= 1.0 ? 1.0 : StudentInflation(n - 2.0));
  return line;
}

}  // namespace howl
