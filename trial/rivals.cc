// Trivial ways to answer: a diagnosis that does not beat them is worth nothing.
#include <algorithm>
#include <cmath>

#include "trial/score.h"

namespace howl {
namespace {

std::string BlockOf(const std::string& id, std::span<const RigEffect> effects) {
  const auto found = std::ranges::find(effects, id, &RigEffect::id);
  return found == effects.end() ? "" : found->block;
}

CaseOutcome Blank(const CaseOutcome& one) {
  CaseOutcome out = one;
  out.kind = "none";
  out.effect.clear();
  out.indistinguishable.clear();
  out.probability = {{"none", 1.0}};
  out.blocks.clear();
  out.gap_after = one.gap_before;
  return out;
}

void Choose(const CandidateOutcome& chosen, std::span<const RigEffect> effects, CaseOutcome& out) {
  out.kind = "effect";
  out.effect = chosen.effect;
  out.blocks = {BlockOf(chosen.effect, effects)};
  out.gap_after = chosen.gap_after;
}

}  // namespace

CaseOutcome AlwaysNone(const CaseOutcome& one) { return Blank(one); }

CaseOutcome LargestGain(const CaseOutcome& one, std::span<const RigEffect> effects) {
  CaseOutcome out = Blank(one);
  const auto best = std::ranges::max_element(one.candidates, {}, &CandidateOutcome::in_sample_gain);
  if (best == one.candidates.end()) return out;
  Choose(*best, effects, out);
  out.probability = {{best->effect, 1.0}};
  return out;
}

CaseOutcome LeastBic(const CaseOutcome& one, std::span<const RigEffect> effects) {
  CaseOutcome out = Blank(one);
  const auto best = std::ranges::max_element(one.candidates, {}, &CandidateOutcome::gain);
  if (best == one.candidates.end()) return out;
  const double top = std::max(0.0, best->gain);
  double total = std::exp(-top);
  for (const CandidateOutcome& each : one.candidates) total += std::exp(each.gain - top);
  out.probability = {{"none", std::exp(-top) / total}};
  for (const CandidateOutcome& each : one.candidates) {
    out.probability[each.effect] = std::exp(each.gain - top) / total;
  }
  if (best->gain > 0.0) Choose(*best, effects, out);
  return out;
}

}  // namespace howl
