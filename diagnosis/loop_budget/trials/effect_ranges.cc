#include "diagnosis/loop_budget/trials/effect_ranges.h"

#include <cmath>
#include <iterator>

namespace howl {
namespace {

// Of the catalogue's cycles, those of the paper's rig.
constexpr double kCyclesOfCatalogue_hz = 210.0;

}  // namespace

double ToSearch(const EffectParameter& parameter, double value) {
  return parameter.scale == ParameterScale::kLogarithmic ? std::log(value) : value;
}

double FromSearch(const EffectParameter& parameter, double u) {
  return parameter.scale == ParameterScale::kLogarithmic ? std::exp(u) : u;
}

Eigen::VectorXd ToSearch(const Effect& effect, const std::vector<double>& values) {
  Eigen::VectorXd out(std::ssize(values));
  for (std::size_t i = 0; i < values.size(); ++i) {
    out[static_cast<Eigen::Index>(i)] = ToSearch(effect.parameters()[i], values[i]);
  }
  return out;
}

double RangeFactor(const Effect& effect, const EffectParameter& parameter,
                   const LoopRecords& records) {
  if (!effect.RangesGoWithCycle()) return 1.0;
  if (parameter.unit != "Hz" && parameter.unit != "s") return 1.0;
  double sum = 0.0;
  for (const double cycle_hz : records.cycle_hz()) sum += std::log(cycle_hz);
  const double cycles_hz = std::exp(sum / static_cast<double>(records.size()));
  return parameter.unit == "Hz" ? cycles_hz / kCyclesOfCatalogue_hz
                                : kCyclesOfCatalogue_hz / cycles_hz;
}

Eigen::VectorXd RangeEnd(const Effect& effect, double EffectParameter::*end,
                         const LoopRecords& records) {
  std::vector<double> out;
  for (const EffectParameter& each : effect.parameters()) {
    out.push_back(RangeFactor(effect, each, records) * each.*end);
  }
  return ToSearch(effect, out);
}

}  // namespace howl
