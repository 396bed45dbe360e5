#include "diagnosis/pair_parts.h"

#include <string>
#include <utility>

#include "model/effects/combined.h"

namespace howl {
namespace {

// What a second effect must bring. After a true first effect others bring 5 at most, while the
// first's form fits (results/trial); it is never exact, so a share of what it brought counts too.
constexpr double kSecondGain = 12.0;
constexpr double kSecondShare = 0.003;

}  // namespace

double LeastSecond(const Attempt& first) {
  return std::max(kSecondGain, kSecondShare * first.candidate.gain);
}

Attempt Join(const Attempt& first, Attempt second) {
  std::vector<EstimatedParameter> parameters;
  for (const Candidate* one : {&first.candidate, &std::as_const(second.candidate)}) {
    for (EstimatedParameter parameter : one->parameters) {
      parameter.name = one->effect + "." + parameter.name;
      parameters.push_back(std::move(parameter));
    }
  }
  Attempt out = std::move(second);
  out.also = out.candidate.block;
  out.second_gain = out.candidate.gain;
  out.candidate.parameters = std::move(parameters);
  out.candidate.effect = CombinedId(first.candidate.effect, out.candidate.effect);
  out.candidate.block = first.candidate.block;
  out.candidate.gain += first.candidate.gain;
  out.parameters += first.parameters;
  out.seen = out.seen || first.seen;
  out.confirmed = out.confirmed || first.confirmed;
  out.without_lines = out.without_lines || first.without_lines;
  return out;
}

std::optional<Attempt> BestPaid(std::vector<std::optional<Attempt>>* tried) {
  std::optional<Attempt> best;
  for (std::optional<Attempt>& attempt : *tried) {
    if (!attempt) continue;
    PayForParameters(&*attempt);
    if (!best || attempt->candidate.gain > best->candidate.gain) best = std::move(attempt);
  }
  return best;
}

std::optional<Attempt> BestGain(const Setting& at, const EffectFit& fit,
                                const std::vector<EffectForms>& units) {
  const GainFluctuation fluctuation = EstimateGainFluctuation(*at.records, fit);
  std::vector<std::optional<Attempt>> tried;
  for (const EffectForms& forms : units) {
    if (forms[0]->kind() == EffectKind::kGain) tried.push_back(TryGain(at, *forms[0], fluctuation));
  }
  return BestPaid(&tried);
}

}  // namespace howl
