#include "estimation/parameters.h"

#include <limits>

namespace howl {

ModelSpec DefaultModelSpec() {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  ModelSpec model;
  model[ParameterKind::kOmega] = {.min = 0.0, .max = kNone};
  model[ParameterKind::kXi] = {.min = 1e-4, .max = 10.0};
  model[ParameterKind::kN] = {.min = 0.0, .max = kNone};
  model[ParameterKind::kM] = {.scope = ParameterScope::kShared, .min = 0.0, .max = kNone};
  model[ParameterKind::kMOverN] = {.scope = ParameterScope::kShared, .min = 1e-4, .max = 1e3};
  model[ParameterKind::kTau] = {.min = 0.0, .max = kNone};
  return model;
}

const ParameterSpec& ModelSpec::Of(ParameterKind kind, std::string_view experiment) const {
  for (const OwnParameter& parameter : own) {
    if (parameter.kind == kind && parameter.experiment == experiment) return parameter.spec;
  }
  return (*this)[kind];
}

}  // namespace howl
