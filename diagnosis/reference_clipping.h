// What saturation alone feigns, against a reference. A saturated signal is put back, or fitted as
// it is, under the reference's response; where that is not the base's form, what is inexact there
// looks like another effect. The same is seen where the reference itself is cut off alike.
#ifndef HOWL_DIAGNOSIS_REFERENCE_CLIPPING_H_
#define HOWL_DIAGNOSIS_REFERENCE_CLIPPING_H_

#include <vector>

#include "diagnosis/cut_record.h"

namespace howl {

// The reference with one signal cut off at either end, so that as many of its samples lie on the
// plateaus as of the rig's in the mean. rig: as recorded.
std::vector<DiagnosisExperiment> ClippedAlike(std::vector<DiagnosisExperiment> reference,
                                              const std::vector<CutRecord>& rig, bool pressure);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_REFERENCE_CLIPPING_H_
