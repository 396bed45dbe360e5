#include "rig/flame.h"

#include <algorithm>
#include <cmath>

#include "rig/constants.h"

namespace rig {
namespace {

double Sigma(FlameShape shape, double x) {
  switch (shape) {
    case FlameShape::kTanh:
      return std::tanh(x);
    case FlameShape::kArctan:
      return 2.0 / kPi * std::atan(0.5 * kPi * x);
    case FlameShape::kErf:
      return std::erf(0.5 * std::sqrt(kPi) * x);
    case FlameShape::kRational: {
      const double y = std::clamp(x, -3.0, 3.0);
      return y * (27.0 + y * y) / (27.0 + 9.0 * y * y);
    }
    case FlameShape::kAsymmetric:
      break;
  }
  constexpr double kBias = 0.25;
  static const double at_rest = std::tanh(kBias);
  return (std::tanh(x + kBias) - at_rest) / (1.0 - at_rest * at_rest);
}

}  // namespace

const std::vector<std::string>& FlameShapeNames() {
  static const std::vector<std::string> names = {"tanh", "arctan", "erf", "rational", "asymmetric"};
  return names;
}

double Flame::operator()(double v) const {
  return saturation * Sigma(shape, slope * v / saturation);
}

double Flame::RelativeGain(double amplitude) const {
  const double x = std::abs(slope) * amplitude / saturation;
  if (x <= 0.0) return 1.0;
  constexpr int kPoints = 512;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double sine = std::sin(2.0 * kPi * (i + 0.5) / kPoints);
    sum += Sigma(shape, x * sine) * sine;
  }
  return 2.0 * sum / (kPoints * x);
}

double Flame::AmplitudeAt(double gain) const {
  double low = 0.0;
  double high = 100.0 * saturation / std::abs(slope);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (RelativeGain(middle) > gain ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace rig
