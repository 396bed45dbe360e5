#include "diagnosis/candidates/attempt.h"
#include "diagnosis/samples/sample_limits.h"

namespace howl {

Attempt TryQuantisation(const AttemptContext& at, const Effect& effect) {
  Attempt out = Named(at, effect);
  FewLevels found = FindQuantisation(*at.records);
  if (at.reference && at.reference->quantisation_levels > 0.0) {
    found.found &= found.levels < 0.67 * at.reference->quantisation_levels;
  }
  out.model_free = found.found;
  out.candidate.parameters.push_back(WithoutError("levels", found.levels, ""));
  return out;
}

}  // namespace howl
