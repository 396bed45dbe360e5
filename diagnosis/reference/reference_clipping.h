// The spurious evidence of other effects that saturation alone gives against a reference. A
// saturated signal is declipped, or fitted as it is, under the reference's response. Where that
// response is not of the base's form, its errors look like another effect. They show as well when
// the reference itself is clipped alike, which is how they are measured.
#ifndef HOWL_DIAGNOSIS_REFERENCE_REFERENCE_CLIPPING_H_
#define HOWL_DIAGNOSIS_REFERENCE_REFERENCE_CLIPPING_H_

#include <vector>

#include "diagnosis/records/cut_record.h"
#include "model/loop/instrument.h"

namespace howl {

// The reference with one signal clipped at either end, so that the share of its samples on the
// plateaus is the mean share of the rig's. rig: as recorded.
std::vector<DiagnosisExperiment> ClippedAlike(std::vector<DiagnosisExperiment> reference,
                                              const std::vector<CutRecord>& rig, Channel channel);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_REFERENCE_REFERENCE_CLIPPING_H_
