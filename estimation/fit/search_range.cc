#include "estimation/fit/search_range.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/units.h"

namespace howl {
namespace {

constexpr double kFarOmega = 1e3;
constexpr double kFarTauLow = 1e-4;
constexpr double kFarTauHigh = 1e3;
constexpr double kFarCoefficient = 1e9;

SearchRange Rails(ParameterKind kind, const Experiment& experiment) {
  const double f = experiment.frequency_hz;
  const double coefficient = kRadPerSPerHz * f * experiment.gain;
  switch (kind) {
    case ParameterKind::kOmega:
      return {f / kFarOmega, kFarOmega * f};
    case ParameterKind::kTau:
      return {kFarTauLow / f, kFarTauHigh / f};
    case ParameterKind::kN:
    case ParameterKind::kM:
      return {coefficient / kFarCoefficient, kFarCoefficient * coefficient};
    case ParameterKind::kXi:
    case ParameterKind::kMOverN:
      break;
  }
  LOG(FATAL) << ParameterName(kind) << " has no dimension, expected bounds of the model's own";
}

}  // namespace

SearchRange MakeSearchRange(ParameterKind kind, const ParameterSpec& spec,
                            std::span<const Experiment> experiments) {
  CHECK(!experiments.empty());
  const bool has_min = spec.min > 0.0;
  const bool has_max = std::isfinite(spec.max);
  if (has_min && has_max) return {spec.min, spec.max};
  SearchRange range{std::numeric_limits<double>::infinity(), 0.0};
  const auto widen = [&](const SearchRange& other) {
    range = {std::min(range.min, other.min), std::max(range.max, other.max)};
  };
  for (const Experiment& experiment : experiments) widen(Rails(kind, experiment));
  constexpr double kBeside = 10.0;  // a value of the spec's own does not stand at a rail
  const auto include = [&](double own) { widen({own / kBeside, own * kBeside}); };
  if (spec.initial) include(*spec.initial);
  if (has_min) include(spec.min);
  if (has_max) include(spec.max);
  return {has_min ? spec.min : range.min, has_max ? spec.max : range.max};
}

}  // namespace howl
