#include "diagnosis/pair/pair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/pair/pair_parts.h"
#include "diagnosis/verdict/verdict.h"
#include "estimation/parallel.h"
#include "model/effects/combined.h"

namespace howl {
namespace {

// Two transfer functions compete, because the second corrects what is inexact in the first. Effects
// that move with the amplitude are modelled to some orders only, so a second must bring more there.
constexpr double kCompetingShare = 0.01;
constexpr double kCompetingShareOfMoving = 0.03;
constexpr std::size_t kFollowed = 3;  // seconds that are fitted until they converge
// A fluctuating gain spreads the cycle's line, and effects that smooth the flame's response fit
// that spread. In 60 rigs with a fluctuating gain alone (results/trial) their spurious gain was at
// most 1.1e-3 of the square of the fluctuation's gain, and at most 0.37 of that gain.
constexpr double kSpuriousByFluctuation = 1.5e-3;  // over the square of the fluctuation's gain
constexpr double kSpuriousShare = 0.45;
constexpr double kBiasGainAtThirtyLevels = 300.0;
constexpr double kBiasInAcoustics = 0.02;  // of that

bool IsLine(const Attempt& attempt) { return IsLineKind(attempt.kind); }

bool Detected(const Attempt& attempt) {
  return attempt.model_free || attempt.candidate.gain > DetectionGain(ShowsInFlameAlone(attempt));
}

// Fluctuations of the gain given the transfer function.
std::vector<Attempt> WithFluctuation(const AttemptContext& at, const Attempt& transfer,
                                     const std::vector<EffectForms>& units) {
  std::vector<Attempt> gains = FluctuationsGiven(at, *transfer.fit, units);
  if (gains.empty() || gains[0].candidate.gain < LeastSecond(transfer)) return {};
  for (Attempt& gain : gains) {
    for (std::size_t e = 0; e < gain.held_out.size(); ++e) {
      gain.held_out[e].acoustic_residual = transfer.held_out[e].acoustic_residual;
    }
    gain = Join(transfer, std::move(gain));
    gain.fit = transfer.fit;
  }
  return gains;
}

// Seconds given coarse quantisation of p. The steps in p give no spurious fluctuating gain
// (results/trial). They are noise of p and do little harm in cut A, but in cut B p drives the
// flame, and errors in it bias what is fitted by their variance. Effects that are fitted to cut B
// gain the square of that bias, which grows as the fourth power of the step.
std::vector<Attempt> SecondsGivenQuantisation(const std::vector<Attempt>& attempts) {
  std::vector<Attempt> gains = NearBestOf(attempts, IsGain);
  if (!gains.empty() && gains[0].candidate.gain > DetectionGain(true)) {
    return JoinAll(attempts[0], std::move(gains));
  }
  const double levels = attempts[0].candidate.parameters[0].value;
  const double bias_gain = kBiasGainAtThirtyLevels * std::pow(30.0 / levels, 4);
  return JoinAll(attempts[0], NearBestOf(attempts, [&](const Attempt& attempt) {
                   if (!IsTransfer(attempt)) return false;
                   const bool flame = attempt.fit->effect->ChangesFlameCut();
                   const double by_bias = flame ? bias_gain : kBiasInAcoustics * bias_gain;
                   return attempt.candidate.gain > std::max(DetectionGain(true), by_bias);
                 }));
}

}  // namespace

std::vector<Attempt> TryDistinctEffects(const AttemptContext& at,
                                        const std::vector<Attempt>& attempts,
                                        const std::vector<EffectForms>& units,
                                        const std::vector<CoherentLine>& lines, int threads) {
  if (attempts.empty()) return {};
  const Attempt& top = attempts[0];
  const Attempt* line = BestOf(attempts, IsLine);
  if (line && line->candidate.gain > DetectionGain(false)) {
    std::vector<Attempt> rest = attempts;
    rest.erase(std::remove_if(rest.begin(), rest.end(), IsLine), rest.end());
    std::vector<Attempt> two = TryDistinctEffects(at, rest, units, lines, threads);
    if (!two.empty()) return JoinAll(*line, std::move(two));
    if (rest.empty() || !Detected(rest[0])) return {};
    // An effect that was detected in the samples is not to be confused with another.
    rest.resize(rest[0].model_free ? 1 : rest.size());
    return JoinAll(*line, NearBest(std::move(rest)));
  }
  if (top.model_free) {
    const Attempt* other = BestOf(
        attempts, [&](const Attempt& attempt) { return attempt.model_free && &attempt != &top; });
    if (other) return JoinAll(top, {*other});
    return top.repaired.empty() ? SecondsGivenQuantisation(attempts)
                                : SecondsGivenClipping(at, attempts, units, lines, threads);
  }
  if (IsGain(top)) {
    const double gain = top.candidate.gain;
    const double least_in_flame_cut = std::max(
        LeastSecond(top), std::min(kSpuriousShare * gain, kSpuriousByFluctuation * gain * gain));
    const Attempt* other = BestOf(attempts, [&](const Attempt& attempt) {
      return IsTransfer(attempt) &&
             attempt.candidate.gain >=
                 (ChangesAcousticCut(attempt) ? LeastSecond(top) : least_in_flame_cut);
    });
    return other ? WithFluctuation(at, *other, units) : std::vector<Attempt>();
  }
  return IsTransfer(top) ? WithFluctuation(at, top, units) : std::vector<Attempt>();
}

double LeastCompeting(const Attempt& first) {
  const bool moving =
      first.fit && (first.fit->effect->ModulatesAcoustics() || first.fit->effect->ModulatesDelay());
  const double share = moving ? kCompetingShareOfMoving : kCompetingShare;
  return std::max(LeastSecond(first), share * first.candidate.gain);
}

std::optional<Attempt> TryTransferPair(const AttemptContext& at, const Attempt& first,
                                       const std::vector<EffectForms>& units, int threads) {
  if (!IsTransfer(first)) return std::nullopt;
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
  std::stable_sort(seconds.begin(), seconds.end(),
                   [](const auto& a, const auto& b) { return a.cost() < b.cost(); });
  std::vector<std::optional<Attempt>> tried(std::min(seconds.size(), kFollowed));
  RunUnits(tried.size(), threads, [&](std::size_t i) {
    tried[i] = FromFit(at, ConvergedFit(*at.records, *at.base, seconds[i]));
  });
  std::vector<Attempt> best = NearBestPaid(std::move(tried));
  const double least = std::max(LeastCompeting(first), NoiseGivenReference(at));
  if (best.empty() || best[0].candidate.gain - first.candidate.gain < least) {
    return std::nullopt;
  }
  return std::move(best[0]);
}

}  // namespace howl
