// Where the records of a rig may have a tone from outside the loop: one frequency for all of them.
//
// In a transform's bins about its frequency f_0 a tone is a multiple of 1 / (f_i - f_0). With u
// that shape in tapered bins (record_spectra.h), and with M_e the median power of p's bins in the
// third of an octave that holds f_0, f_0 is where
//
//   sum over records e of |u^H P_e|^2 / (|u|^2 M_e)
//
// is largest, over the records whose cycles have no line there. It is a start for the item
// external_tone, which has to pay; whether there is a tone is not said here.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_TONE_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_TONE_H_

#include "diagnosis/loop_budget/forms/loop_records.h"

namespace howl {

// In Hz; 0: the records have no frequency in common.
double ToneIn(const LoopRecords& records);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_FORMS_TONE_H_
