#include "estimation/family/problem/family_parameter.h"

#include <limits>

#include "model/loop/loop.h"

namespace howl {

bool HasParameter(const FamilyProblem& problem, std::size_t experiment, FamilyParameter parameter) {
  if (parameter == FamilyParameter::kLoopGain) {
    return problem.experiments[experiment].flame_slope.has_value();
  }
  if (parameter == FamilyParameter::kM) return problem.model.modes == 2;
  return true;
}

bool IsSharedParameter(const FamilyProblem& problem, FamilyParameter parameter) {
  switch (parameter) {
    case FamilyParameter::kOmega:
      return problem.IsShared(ParameterKind::kOmega);
    case FamilyParameter::kXi:
      return problem.IsShared(ParameterKind::kXi);
    case FamilyParameter::kN:
      return problem.IsShared(ParameterKind::kN);
    case FamilyParameter::kM:
      return problem.IsShared(ParameterKind::kM);
    case FamilyParameter::kTau:
      return problem.IsShared(ParameterKind::kTau);
    case FamilyParameter::kLoopGain:
      break;
  }
  return false;
}

double ParameterValue(const Experiment& experiment, const LoopModel& model,
                      FamilyParameter parameter) {
  switch (parameter) {
    case FamilyParameter::kOmega:
      return model.omega_hz;
    case FamilyParameter::kXi:
      return model.xi;
    case FamilyParameter::kN:
      return model.N;
    case FamilyParameter::kM:
      return model.M;
    case FamilyParameter::kTau:
      return model.tau_s;
    case FamilyParameter::kLoopGain:
      break;
  }
  return experiment.flame_slope
             ? LoopGain(model.Loop(), experiment.frequency_hz, *experiment.flame_slope)
             : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace howl
