// Whether each experiment has a delay of its own.
#include <algorithm>
#include <vector>

#include "diagnosis/search/search.h"

namespace howl {
namespace {

// ln 19, in nats: the effect is preferred to own delays at odds of 19 to 1.
constexpr double kLogOddsToAccuse = 2.944438979166440;

}  // namespace

bool DelaysDiffer(double own_delays_gain) { return own_delays_gain > DetectionGain(true); }

// Own delays that gain as much as the best effect replace it: a rig is not accused of what may be
// no more than the different delays of its operating points. Where the effect gains more, own
// delays are tried in addition to it.
double Search::OwnDelaysGain() const {
  std::vector<CutRecord> records = records_;
  for (CutRecord& record : records) record.model.own_delays = true;
  const EffectFit base = FitBase(records);
  const auto best = std::ranges::max_element(
      attempts_, {}, [](const Attempt& attempt) { return attempt.candidate.gain; });
  if (best == attempts_.end() || best->candidate.gain <= 0.0 || !ShowsInFlame(*best) ||
      GainOver(base, *best->fit) < kLogOddsToAccuse) {
    return base_.cost() - base.cost();
  }
  return best->fit->cost() - ConvergedFit(records, base, *best->fit).cost();
}

}  // namespace howl
