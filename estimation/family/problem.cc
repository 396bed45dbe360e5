#include "estimation/family/problem.h"

namespace howl {

namespace {

double Value(const LoopModel& model, ParameterKind kind) {
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

}  // namespace

bool Holds(const FamilyProblem& problem, std::span<const LoopModel> models) {
  constexpr double kSameShared = 1e-9;  // M / N is formed by a division
  for (const ParameterKind kind : kParameterKinds) {
    if (!problem.model.Uses(kind)) continue;
    const Range range = problem.RangeOf(kind);
    const double first = Value(models[0], kind);
    for (const LoopModel& model : models) {
      const double value = Value(model, kind);
      const double slack = kSameShared * std::abs(value);
      if (!(value > 0.0) || value < range.lo - slack || value > range.hi + slack) return false;
      if (problem.IsShared(kind) && std::abs(value - first) > slack) return false;
    }
  }
  return IsMember(problem.experiments, models, problem.test);
}

}  // namespace howl
