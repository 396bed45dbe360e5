// The parts of the search for a second effect (pair.h).
#ifndef HOWL_DIAGNOSIS_PAIR_PAIR_PARTS_H_
#define HOWL_DIAGNOSIS_PAIR_PAIR_PARTS_H_

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/candidates/effect_forms.h"

namespace howl {

inline bool IsGain(const Attempt& attempt) { return IsGainKind(attempt.kind); }
inline bool IsTransfer(const Attempt& attempt) { return attempt.fit.has_value(); }
inline bool ChangesAcousticCut(const Attempt& attempt) {
  return attempt.fit && attempt.fit->effect->ChangesAcousticCut();
}

// The least gain that a second effect must bring given this first.
double LeastSecond(const Attempt& first);

// The first attempt for which the predicate is true; null if there is none. attempts: the best
// first.
template <typename Predicate>
const Attempt* BestOf(const std::vector<Attempt>& attempts, Predicate&& is) {
  const auto found = std::find_if(attempts.begin(), attempts.end(), is);
  return found == attempts.end() ? nullptr : &*found;
}

// `second` as it is, with the first's name, block and parameters before its own.
Candidate JoinCandidates(const Candidate& first, Candidate second);
Attempt Join(const Attempt& first, Attempt second);

std::vector<Attempt> JoinAll(const Attempt& first, std::vector<Attempt> seconds);

// The attempts that the data can hardly tell from the best; attempts: the best first.
std::vector<Attempt> NearBest(std::vector<Attempt> attempts);

// Of `attempts` (the best first) the best with a true predicate, and those with one near it.
template <typename Predicate>
std::vector<Attempt> NearBestOf(const std::vector<Attempt>& attempts, Predicate&& is) {
  std::vector<Attempt> fitting;
  std::copy_if(attempts.begin(), attempts.end(), std::back_inserter(fitting), is);
  return NearBest(std::move(fitting));
}

// With the price of parameters subtracted: the best first, then those near it; empty if none was
// tried.
std::vector<Attempt> NearBestPaid(std::vector<std::optional<Attempt>> tried);

// Fluctuations of the flame's gain given this fit: the best kind first, then those near it.
std::vector<Attempt> FluctuationsGiven(const AttemptContext& at, const EffectFit& fit,
                                       const std::vector<EffectForms>& units);

// Second effects given clipped q, which is the best of `attempts` (pair_clipping.cc).
std::vector<Attempt> SecondsGivenClipping(const AttemptContext& at,
                                          const std::vector<Attempt>& attempts,
                                          const std::vector<EffectForms>& units,
                                          const std::vector<CoherentLine>& lines, int threads);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PAIR_PAIR_PARTS_H_
