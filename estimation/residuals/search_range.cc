#include "estimation/residuals/search_range.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr double kFarOmega = 1e3;
constexpr double kFarTauLow = 1e-4;
constexpr double kFarTauHigh = 1e3;
constexpr double kFarCoefficient = 1e9;

void Widen(SearchRange& range, const SearchRange& other) {
  range = {std::min(range.min, other.min), std::max(range.max, other.max)};
}

}  // namespace

SearchRails::SearchRails(std::span<const Experiment> experiments) {
  CHECK(!experiments.empty());
  constexpr SearchRange kNone{std::numeric_limits<double>::infinity(), 0.0};
  omega_ = tau_ = coefficient_ = kNone;
  for (const Experiment& experiment : experiments) {
    const double f = experiment.frequency_hz;
    const double coefficient = kRadPerSPerHz * f * experiment.gain;
    Widen(omega_, {f / kFarOmega, kFarOmega * f});
    Widen(tau_, {kFarTauLow / f, kFarTauHigh / f});
    Widen(coefficient_, {coefficient / kFarCoefficient, kFarCoefficient * coefficient});
  }
}

SearchRange SearchRails::RangeOf(ParameterKind kind, const ParameterSpec& spec) const {
  const bool has_min = spec.min > 0.0;
  const bool has_max = std::isfinite(spec.max);
  if (has_min && has_max) return {spec.min, spec.max};
  CHECK(kind != ParameterKind::kXi && kind != ParameterKind::kMOverN)
      << ParameterName(kind) << " has no dimension, expected bounds of the model's own";
  SearchRange range = coefficient_;
  if (kind == ParameterKind::kOmega) range = omega_;
  if (kind == ParameterKind::kTau) range = tau_;
  constexpr double kOwnValueFactor = 10.0;  // keeps a value that the config states off the rails
  const auto include = [&](double own) {
    Widen(range, {own / kOwnValueFactor, own * kOwnValueFactor});
  };
  if (spec.initial) include(*spec.initial);
  if (has_min) include(spec.min);
  if (has_max) include(spec.max);
  return {has_min ? spec.min : range.min, has_max ? spec.max : range.max};
}

}  // namespace howl
