// Two effects at once, or a line and two others. Evidence of different kinds adds up: a coherent
// line, clipping, few levels, a fluctuating gain and a transfer function do not compete for the
// same misfit, so two of them, each beyond what noise gives, are two effects.
//
// Two transfer functions do compete: together they have freedom enough to imitate an effect that
// is not in the catalogue. Where the best needs such a second the verdict is unknown, and the pair
// is reported with it.
#ifndef HOWL_DIAGNOSIS_PAIR_PAIR_H_
#define HOWL_DIAGNOSIS_PAIR_PAIR_H_

#include <optional>
#include <vector>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/candidates/effect_forms.h"

namespace howl {

// The most probable combination first, then those that the data can hardly tell from it. Where the
// second effect may be spurious (Attempt::may_be_spurious) the best alone comes before the pair.
// Empty if there is no more than one effect. attempts: the best first.
std::vector<Attempt> TryDistinctEffects(const AttemptContext& at,
                                        const std::vector<Attempt>& attempts,
                                        const std::vector<EffectForms>& units,
                                        const std::vector<CoherentLine>& lines, int threads);

// What a second transfer function must bring to compete with the first.
double LeastCompeting(const Attempt& first);

// The best second transfer function given the best; nothing if it brings no more than noise does.
std::optional<Attempt> TryTransferPair(const AttemptContext& at, const Attempt& first,
                                       const std::vector<EffectForms>& units, int threads);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PAIR_PAIR_H_
