// Instruments of q between the loop and its record, as effects of the catalogue have them:
//
//   Q_recorded = H_q Q + leak P_recorded,     so that Q = (Q_recorded - leak P_recorded) / H_q
//
// is what the loop is fitted to. The likelihood of what was recorded has the Jacobian of that,
// which is what a bin counts for times -2 ln |H_q|.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_INSTRUMENT_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_INSTRUMENT_H_

#include <vector>

#include "estimation/record_fit/spectra/record_spectra.h"
#include "model/effects/effect.h"

namespace howl {

struct LoopInstrument {
  EffectPointer effect;
  double value = 0.0;  // of its parameter
};

// Those of the catalogue, with one parameter, in all their forms.
std::vector<EffectPointer> InstrumentsOfHeatRelease();

// The record as it would be without the instrument.
RecordSpectra WithoutInstrument(RecordSpectra record, const LoopInstrument& instrument);

// ln of the Jacobian, of one and of several.
double LogJacobian(const RecordSpectra& record, const LoopInstrument& instrument);
double LogJacobian(const RecordSpectra& record, const std::vector<LoopInstrument>& instruments);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_LOOP_INSTRUMENT_H_
