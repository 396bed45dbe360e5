#include "diagnosis/pair/pair_parts.h"

#include <algorithm>
#include <string>
#include <utility>

#include "diagnosis/verdict/verdict.h"
#include "model/effects/combined.h"

namespace howl {
namespace {

// The gain that a second effect must bring. After a true first effect others bring 5 at most if the
// first's form fits (results/trial). No form is exact, so a share of the first's gain counts too.
constexpr double kSecondGain = 12.0;
constexpr double kSecondShare = 0.003;
constexpr double kNear = 4.0;  // temperatures of the odds (verdict.h)

}  // namespace

double LeastSecond(const Attempt& first) {
  return std::max(kSecondGain, kSecondShare * first.candidate.gain);
}

Candidate JoinCandidates(const Candidate& first, Candidate second) {
  std::vector<EstimatedParameter> parameters;
  for (const Candidate* one : {&first, &std::as_const(second)}) {
    const bool named = one->effect.find('+') != std::string::npos;  // with their effects already
    for (EstimatedParameter parameter : one->parameters) {
      if (!named) parameter.name = one->effect + "." + parameter.name;
      parameters.push_back(std::move(parameter));
    }
  }
  second.parameters = std::move(parameters);
  second.effect = CombinedId(first.effect, second.effect);
  second.block = first.block;
  second.gain += first.gain;
  return second;
}

Attempt Join(const Attempt& first, Attempt second) {
  Attempt out = std::move(second);
  if (out.also.empty()) out.second_gain = out.candidate.gain;
  out.also.insert(out.also.begin(), out.candidate.block);
  out.candidate = JoinCandidates(first.candidate, std::move(out.candidate));
  out.parameters += first.parameters;
  out.model_free = out.model_free || first.model_free;
  out.confirmed = out.confirmed || first.confirmed;
  out.without_lines = out.without_lines || first.without_lines;
  return out;
}

std::vector<Attempt> JoinAll(const Attempt& first, std::vector<Attempt> seconds) {
  for (Attempt& second : seconds) second = Join(first, std::move(second));
  return seconds;
}

std::vector<Attempt> NearBest(std::vector<Attempt> attempts) {
  if (attempts.empty()) return attempts;
  const double best = attempts[0].candidate.gain;
  const double least = best - kNear * Temperature(best);
  const auto far = [&](const Attempt& attempt) { return attempt.candidate.gain < least; };
  attempts.erase(std::remove_if(attempts.begin(), attempts.end(), far), attempts.end());
  return attempts;
}

std::vector<Attempt> NearBestPaid(std::vector<std::optional<Attempt>> tried) {
  std::vector<Attempt> attempts;
  for (std::optional<Attempt>& attempt : tried) {
    if (!attempt) continue;
    PayForParameters(&*attempt);
    attempts.push_back(std::move(*attempt));
  }
  std::stable_sort(attempts.begin(), attempts.end(), [](const Attempt& a, const Attempt& b) {
    return a.candidate.gain > b.candidate.gain;
  });
  return NearBest(std::move(attempts));
}

std::vector<Attempt> FluctuationsGiven(const AttemptContext& at, const EffectFit& fit,
                                       const std::vector<EffectForms>& units) {
  const GainFluctuation fluctuation = EstimateGainFluctuation(*at.records, fit);
  std::vector<std::optional<Attempt>> tried;
  for (const EffectForms& forms : units) {
    if (IsGainKind(forms[0]->kind())) tried.push_back(TryGain(at, *forms[0], fluctuation));
  }
  return NearBestPaid(std::move(tried));
}

}  // namespace howl
