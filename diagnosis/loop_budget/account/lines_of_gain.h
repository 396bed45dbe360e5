// Errors at the cycle's lines that a fluctuating gain of the flame makes. As a source of noise such
// a gain is modelled to first order (noise_shape.h), without a mean at the lines. But the cycle
// follows its flame: it is louder while the gain is large. Of what the flame gives out about the
// h-th line, (1 + g) A_h, the mean is then off by as much as
//
//   |mean(g (|A_h| - mean |A_h|))| <= rms(g A_h) / rms(A_h) rms(|A_h| - mean |A_h|)
//
// (Cauchy and Schwarz), where A_h is what the loop foretells of q about the line and g A_h what it
// leaves there.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_LINES_OF_GAIN_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_LINES_OF_GAIN_H_

#include "diagnosis/loop_budget/forms/loop_records.h"
#include "diagnosis/loop_budget/trials/loop_starts.h"

namespace howl {

// Over what the loop foretells of q's lines, root mean squares over all lines and points.
struct LinesOfGain {
  double missed = 0.0;
  double bound = 0.0;  // zero where the loop's gain does not fluctuate
};

// fit: of a loop whose flame errs at the lines.
LinesOfGain LinesOfGainIn(const LoopRecords& records, const LoopFit& fit);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_LINES_OF_GAIN_H_
