#include "estimation/parameters.h"

namespace howl {

ModelSpec DefaultModelSpec() {
  ModelSpec model;
  model[ParameterKind::kOmega] = {.min = 1.0, .max = 1e5};
  model[ParameterKind::kXi] = {.min = 1e-4, .max = 10.0};
  model[ParameterKind::kN] = {.min = 1e-6, .max = 1e12};
  model[ParameterKind::kM] = {.scope = ParameterScope::kShared, .min = 1e-6, .max = 1e12};
  model[ParameterKind::kMOverN] = {.scope = ParameterScope::kShared, .min = 1e-4, .max = 1e3};
  model[ParameterKind::kTau] = {.min = 1e-6, .max = 1.0};
  return model;
}

const ParameterSpec& ModelSpec::Of(ParameterKind kind, std::string_view experiment) const {
  for (const OwnParameter& parameter : own) {
    if (parameter.kind == kind && parameter.experiment == experiment) return parameter.spec;
  }
  return (*this)[kind];
}

}  // namespace howl
