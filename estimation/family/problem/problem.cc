#include "estimation/family/problem/problem.h"

#include <algorithm>
#include <limits>

namespace howl {

double ParameterOf(const LoopModel& model, ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kOmega:
      return model.omega_hz;
    case ParameterKind::kXi:
      return model.xi;
    case ParameterKind::kN:
      return model.N;
    case ParameterKind::kM:
      return model.M;
    case ParameterKind::kMOverN:
      return model.M / model.N;
    case ParameterKind::kTau:
      return model.tau_s;
  }
  return 0.0;
}

Range FamilyProblem::RangeOf(ParameterKind kind, std::size_t experiment) const {
  const ParameterSpec& spec = model.Of(kind, experiments[experiment].name);
  if (spec.fixed && spec.initial) return {*spec.initial, *spec.initial};
  Range range = domain[kind];
  if (&spec == &model[kind]) return range;
  // Guard rails of the fit that nobody moved do not belong to the test.
  const ParameterSpec guard = DefaultModelSpec()[kind];
  if (spec.min != guard.min) range.lo = spec.min;
  if (spec.max != guard.max) range.hi = spec.max;
  return range;
}

Range FamilyProblem::RangeOf(ParameterKind kind) const {
  Range hull{std::numeric_limits<double>::infinity(), 0.0};
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const Range range = RangeOf(kind, i);
    hull = {std::min(hull.lo, range.lo), std::max(hull.hi, range.hi)};
  }
  return hull;
}

bool Holds(const FamilyProblem& problem, std::span<const LoopModel> models) {
  constexpr double kSameShared = 1e-9;  // M / N is formed by a division
  for (const ParameterKind kind : kParameterKinds) {
    if (!problem.model.Uses(kind)) continue;
    const double first = ParameterOf(models[0], kind);
    for (std::size_t i = 0; i < models.size(); ++i) {
      const Range range = problem.RangeOf(kind, i);
      const double value = ParameterOf(models[i], kind);
      const double slack = kSameShared * std::abs(value);
      if (!(value > 0.0) || value < range.lo - slack || value > range.hi + slack) return false;
      if (problem.IsShared(kind) && std::abs(value - first) > slack) return false;
    }
  }
  return IsMember(problem.experiments, models, problem.test);
}

}  // namespace howl
