// Parameters of the loop that differ between the fit without an effect and the fit with it: such a
// parameter had absorbed part of the effect and is a symptom of it.
#ifndef HOWL_DIAGNOSIS_FIT_MOVED_PARAMETERS_H_
#define HOWL_DIAGNOSIS_FIT_MOVED_PARAMETERS_H_

#include <string>
#include <vector>

#include "diagnosis/fit/effect_fit.h"

namespace howl {

struct MovedParameter {
  std::string name;  // "tau_s", "EXPERIMENT.omega_hz"
  double without = 0.0;
  double with = 0.0;
};

// Compares tau, then omega, xi, N and M of each experiment.
std::vector<MovedParameter> MovedParameters(const std::vector<CutRecord>& records,
                                            const EffectFit& without, const EffectFit& with);

// The `most` parameters that move farthest, by at least the share `least` of their value; the
// farthest first.
std::vector<MovedParameter> FarthestMoved(std::vector<MovedParameter> moved, std::size_t most,
                                          double least);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_MOVED_PARAMETERS_H_
