#include "diagnosis/search/second_effect.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "diagnosis/verdict/verdict.h"
#include "estimation/parallel.h"
#include "model/effects/combined.h"

namespace howl {
namespace {

// Two transfer functions compete, because the second corrects what is inexact in the first. Effects
// that move with the amplitude are modelled to some orders only, so a second must bring more there.
constexpr double kCompetingShare = 0.01;
constexpr double kCompetingShareOfMoving = 0.03;
// After a true first effect others bring 5 at most if the first's form fits (results/trial).
constexpr double kSecondGain = 12.0;
constexpr double kNear = 4.0;         // temperatures of the odds (verdict.h)
constexpr std::size_t kFollowed = 3;  // seconds that are fitted until they converge

// `other` as it is, with the line's name, block and parameters before its own.
Attempt Join(const Attempt& line, Attempt other) {
  std::vector<EstimatedParameter> parameters;
  for (const Candidate* one : {&line.candidate, &std::as_const(other.candidate)}) {
    for (EstimatedParameter parameter : one->parameters) {
      parameter.name = one->effect + "." + parameter.name;
      parameters.push_back(std::move(parameter));
    }
  }
  other.also = other.candidate.block;
  other.second_gain = other.candidate.gain;
  other.candidate.parameters = std::move(parameters);
  other.candidate.effect = CombinedId(line.candidate.effect, other.candidate.effect);
  other.candidate.block = line.candidate.block;
  other.candidate.gain += line.candidate.gain;
  other.parameters += line.parameters;
  other.without_lines = true;
  return other;
}

double Detection(const Attempt& attempt) { return DetectionGain(ShowsInFlameAlone(attempt)); }

}  // namespace

std::vector<Attempt> BesideALine(const std::vector<Attempt>& attempts) {
  const auto line = std::ranges::find_if(attempts, IsLineKind, &Attempt::kind);
  const auto other = std::ranges::find_if_not(attempts, IsLineKind, &Attempt::kind);
  if (line == attempts.end() || other == attempts.end()) return {};
  const double most = other->candidate.gain;
  if (line->candidate.gain <= DetectionGain(false) || most <= Detection(*other)) return {};
  std::vector<Attempt> out;
  for (const Attempt& each : attempts) {
    if (IsLineKind(each.kind) || each.candidate.gain < most - kNear * Temperature(most)) continue;
    out.push_back(Join(*line, each));
  }
  return out;
}

double LeastCompeting(const Attempt& first) {
  const bool moving =
      first.fit && (first.fit->effect->ModulatesAcoustics() || first.fit->effect->ModulatesDelay());
  const double share = moving ? kCompetingShareOfMoving : kCompetingShare;
  return std::max(kSecondGain, share * first.candidate.gain);
}

std::optional<Attempt> TryTransferPair(const AttemptContext& at, const Attempt& first,
                                       const std::vector<EffectForms>& units, int threads) {
  if (!first.fit) return std::nullopt;
  std::vector<std::optional<EffectFit>> preliminary(units.size());
  RunUnits(units.size(), threads, [&](std::size_t i) {
    const EffectForms& forms = units[i];
    if (forms[0]->kind() != EffectKind::kTransfer || forms[0]->id() == first.fit->effect->id()) {
      return;
    }
    for (const EffectPointer& form : forms) {
      EffectFit fit =
          PreliminaryFit(*at.records, Combine(first.fit->effect, form), *at.base, *first.fit);
      if (!preliminary[i] || fit.cost() < preliminary[i]->cost()) preliminary[i] = std::move(fit);
    }
  });
  std::vector<EffectFit> seconds;
  for (std::optional<EffectFit>& fit : preliminary) {
    if (fit) seconds.push_back(std::move(*fit));
  }
  std::ranges::stable_sort(seconds, {}, [](const EffectFit& fit) { return fit.cost(); });
  std::vector<Attempt> tried(std::min(seconds.size(), kFollowed));
  RunUnits(tried.size(), threads, [&](std::size_t i) {
    tried[i] = FromFit(at, ConvergedFit(*at.records, *at.base, seconds[i]));
    PayForParameters(&tried[i]);
  });
  const auto best = std::ranges::max_element(
      tried, {}, [](const Attempt& attempt) { return attempt.candidate.gain; });
  const double least = std::max(LeastCompeting(first), NoiseGivenReference(at));
  if (best == tried.end() || best->candidate.gain - first.candidate.gain < least) {
    return std::nullopt;
  }
  return std::move(*best);
}

}  // namespace howl
