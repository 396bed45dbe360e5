// What a search for one cause says of a second one. A coherent line does not compete with anything
// for the same misfit, as it is taken out of the fits: a line and one other effect, each beyond
// what noise gives, are two effects.
//
// Two transfer functions do compete: together they have freedom enough to imitate an effect that
// is not in the catalogue. Where the best needs such a second the verdict is unknown, and the pair
// is reported with it.
#ifndef HOWL_DIAGNOSIS_SEARCH_SECOND_EFFECT_H_
#define HOWL_DIAGNOSIS_SEARCH_SECOND_EFFECT_H_

#include <optional>
#include <vector>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/candidates/effect_forms.h"

namespace howl {

// The line with the best of the others, then with those that the data can hardly tell from that
// one. Empty without a line, or without another. attempts: the best first.
std::vector<Attempt> BesideALine(const std::vector<Attempt>& attempts);

// What a second transfer function must bring to compete with the first.
double LeastCompeting(const Attempt& first);

// The best second transfer function given the best; nothing if it brings no more than noise does.
std::optional<Attempt> TryTransferPair(const AttemptContext& at, const Attempt& first,
                                       const std::vector<EffectForms>& units, int threads);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_SEARCH_SECOND_EFFECT_H_
