// An effect's parameter as a diagnosis reports it, and where in the loop an error lies.
#ifndef HOWL_DIAGNOSIS_FIT_ESTIMATED_PARAMETER_H_
#define HOWL_DIAGNOSIS_FIT_ESTIMATED_PARAMETER_H_

#include <string>
#include <vector>

#include "model/effects/effect.h"

namespace howl {

struct EstimatedParameter {
  std::string name;
  double value = 0.0;
  double low = 0.0;  // 95 %; NaN where no error was estimated
  double high = 0.0;
  std::string unit;
  bool at_bound = false;  // of the search: the value is that of the bound, not of the data
};

// With the interval of a normal error in the coordinate of the search (log x or x).
EstimatedParameter WithError(const EffectParameter& parameter, double value, double error);

// True where the value lies within a millionth of the search's range from either end of the range;
// in logarithms where the parameter's scale is logarithmic.
bool StandsAtBound(const EffectParameter& parameter, double value);

struct Place {
  LoopBlock block = LoopBlock::kAcoustics;
  double low_hz = 0.0;
  double high_hz = 0.0;
  std::vector<std::string> experiments;
  double share = 0.0;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_FIT_ESTIMATED_PARAMETER_H_
