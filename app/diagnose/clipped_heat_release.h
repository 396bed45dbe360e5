// Whether q was clipped before noise came to it. Its density then ends in edges, as it does where a
// flame saturates as sharply: the samples do not tell the two apart, and no likelihood of a loop
// holds for the first. p does, as the acoustics are driven by what q was before it was clipped: the
// search for one cause (diagnosis.h) weighs q_clipping against all else that explains both signals.
#ifndef HOWL_APP_DIAGNOSE_CLIPPED_HEAT_RELEASE_H_
#define HOWL_APP_DIAGNOSE_CLIPPED_HEAT_RELEASE_H_

#include <optional>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "estimation/analysis/analyse.h"

namespace howl {

// Of most records. Not of samples that repeat at the ends of the range, which tell it themselves.
bool HeatReleaseMayBeClipped(const std::vector<NamedRecord>& records);

// The diagnosis, if it is q_clipping. Throws Interrupted.
std::optional<Diagnosis> DiagnoseClippedHeatRelease(const std::vector<NamedRecord>& records,
                                                    const DiagnosisOptions& options);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_CLIPPED_HEAT_RELEASE_H_
