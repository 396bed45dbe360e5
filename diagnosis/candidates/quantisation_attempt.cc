#include "diagnosis/candidates/attempt.h"
#include "diagnosis/static_map.h"

namespace howl {

Attempt TryQuantisation(const Setting& at, const Effect& effect) {
  Attempt out = Named(at, effect);
  const FewLevels found = FindQuantisation(*at.records);
  out.seen = found.found;
  out.candidate.parameters.push_back(WithoutError("levels", found.levels, ""));
  return out;
}

}  // namespace howl
