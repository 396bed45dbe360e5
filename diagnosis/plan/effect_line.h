// One effect of the catalogue as a line that a plan walks along: one parameter, the size, goes from
// its null to the search's bound, and the others stay where a search would start.
//
//   size = 1 / x                 null at infinity (a cut-off)
//          log(x / null)         null in the middle of a logarithmic range (a ratio)
//          x - null              otherwise
//
// The size is the parameter that turns the effect off at its null, whatever the others are.
#ifndef HOWL_DIAGNOSIS_PLAN_EFFECT_LINE_H_
#define HOWL_DIAGNOSIS_PLAN_EFFECT_LINE_H_

#include <cstddef>
#include <vector>

#include "diagnosis/records/cut_record.h"
#include "model/effects/effect.h"

namespace howl {

struct EffectLine {
  EffectPointer effect;
  std::vector<double> values;      // the size's entry is not used
  std::size_t size_parameter = 0;  // its number
  double typical = 0.0;            // size at which a search starts
  double largest = 0.0;            // size at the search's bound
  bool both_signs = false;         // the search goes to either side of the null

  const EffectParameter& parameter() const { return effect->parameters()[size_parameter]; }
  // The parameter's value at this size.
  double ParameterAt(double size) const;
  // All parameters at this size.
  std::vector<double> ValuesAt(double size) const;
};

// The effect's lines, one for each combination of the other parameters' starts. Where each of them
// has one start, it is also taken at a third and at three times of it. `record`: of an
// experiment, for the frequencies at which the effect is looked at. Empty for an effect that is no
// transfer function, or that none of its parameters turns off.
std::vector<EffectLine> EffectLines(const EffectPointer& effect, const CutRecord& record);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_EFFECT_LINE_H_
