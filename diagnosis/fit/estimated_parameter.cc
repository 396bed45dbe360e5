#include "diagnosis/fit/estimated_parameter.h"

#include <algorithm>
#include <cmath>

#include "estimation/analysis/spectra/half_width.h"

namespace howl {
namespace {

constexpr double kAtBound = 1e-6;

}  // namespace

EstimatedParameter WithError(const EffectParameter& p, double value, double error) {
  EstimatedParameter out{p.name, value, value - HalfWidth95(error), value + HalfWidth95(error),
                         p.unit};
  if (p.scale == ParameterScale::kLogarithmic && value > 0.0) {
    const double factor = std::exp(std::min(HalfWidth95(error) / value, 20.0));
    out.low = value / factor;
    out.high = value * factor;
  }
  out.at_bound = StandsAtBound(p, value);
  return out;
}

bool StandsAtBound(const EffectParameter& parameter, double value) {
  const auto scaled = [&](double x) {
    return parameter.scale == ParameterScale::kLogarithmic ? std::log(x) : x;
  };
  const double low = scaled(parameter.low);
  const double high = scaled(parameter.high);
  const double enough = kAtBound * (high - low);
  return scaled(value) - low <= enough || high - scaled(value) <= enough;
}

}  // namespace howl
