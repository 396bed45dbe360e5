// Effects of the catalogue whose parameters all operating points share: of the instrument of q,
//
//   Q_recorded = H_q Q + leak P_recorded,     so that Q = (Q_recorded - leak P_recorded) / H_q
//
// is what the loop is fitted to, and filters before and behind the flame's curve, which the record
// is made ready with (record_spectra.h). The likelihood of what was recorded has the Jacobian of
// the division, which is what a bin counts for times -2 ln |H_q|.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_SHARED_EFFECT_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_SHARED_EFFECT_H_

#include <vector>

#include "estimation/record_fit/spectra/record_spectra.h"
#include "model/effects/effect.h"

namespace howl {

struct SharedEffect {
  EffectPointer effect;
  std::vector<double> values;  // of its parameters
};

// Of a flame. A second path behind the curve is none: it is the loop's own, with other values at
// each operating point (loop_point.h).
bool IsFlameFilter(const Effect& effect);

// Those of q's instrument, with one parameter, and the flame's filters, in all their forms.
std::vector<EffectPointer> SharedEffects();

// The record as it would be without an instrument, or with the flame's filter.
RecordSpectra RecordBeside(RecordSpectra record, const SharedEffect& shared);

// ln of the Jacobian, of one and of several.
double LogJacobian(const RecordSpectra& record, const SharedEffect& shared);
double LogJacobian(const RecordSpectra& record, const std::vector<SharedEffect>& effects);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_SHARED_EFFECT_H_
