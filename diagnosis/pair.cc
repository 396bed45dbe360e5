#include "diagnosis/pair.h"

#include <algorithm>
#include <string>
#include <utility>

#include "diagnosis/slack.h"
#include "diagnosis/verdict.h"
#include "estimation/parallel.h"
#include "model/effects/combined.h"

namespace howl {
namespace {

// What a second effect must bring. After a true first effect others bring 5 at most, while the
// first's form fits (results/trial); it is never exact, so a share of what it brought counts too.
constexpr double kSecondGain = 12.0;
constexpr double kSecondShare = 0.003;
// Two transfer functions compete: the second mends what is inexact in the first, as a low-pass that
// a rig's recorder has in discrete time.
constexpr double kCompetingShare = 0.03;
// A fluctuating gain spreads the cycle's line: effects that smooth the flame's answer fit that.
constexpr double kBesideFluctuationShare = 0.45;
constexpr double kBesideFluctuationGain = 100.0;
// Clipped samples are put back roughly, those of q more so: p tells of them through cut A alone.
constexpr double kAfterRepairGain = 60.0;
constexpr double kAfterPressureRepairShare = 0.016;
constexpr double kAfterHeatReleaseRepairShare = 0.4;

bool IsGain(const Attempt& attempt) { return attempt.kind == EffectKind::kGain; }
bool IsLine(const Attempt& attempt) { return attempt.kind == EffectKind::kLine; }
bool IsTransfer(const Attempt& attempt) { return attempt.fit.has_value(); }

bool Detected(const Attempt& attempt) {
  const bool flame_alone = attempt.fit && !attempt.fit->effect->ChangesAcousticCut();
  return attempt.seen || attempt.candidate.gain > DetectionGain(flame_alone);
}

template <typename Predicate>
const Attempt* BestOf(const std::vector<Attempt>& attempts, Predicate&& is) {
  const auto found = std::find_if(attempts.begin(), attempts.end(), is);
  return found == attempts.end() ? nullptr : &*found;
}

// `second` as it is, with the first's name and parameters before its own.
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

// Parameters paid for; nothing if none was tried. Takes it out of `tried`.
std::optional<Attempt> Best(std::vector<std::optional<Attempt>>* tried) {
  std::optional<Attempt> best;
  for (std::optional<Attempt>& attempt : *tried) {
    if (!attempt) continue;
    PayForParameters(&*attempt);
    if (!best || attempt->candidate.gain > best->candidate.gain) best = std::move(attempt);
  }
  return best;
}

double LeastSecond(const Attempt& first) {
  return std::max(kSecondGain, kSecondShare * first.candidate.gain);
}

bool ChangesAcousticCut(const Attempt& attempt) {
  return attempt.fit && attempt.fit->effect->ChangesAcousticCut();
}

std::optional<Attempt> BestGain(const Setting& at, const EffectFit& fit,
                                const std::vector<EffectForms>& units) {
  const GainFluctuation fluctuation = EstimateGainFluctuation(*at.records, fit);
  std::vector<std::optional<Attempt>> tried;
  for (const EffectForms& forms : units) {
    if (forms[0]->kind() == EffectKind::kGain) tried.push_back(TryGain(at, *forms[0], fluctuation));
  }
  return Best(&tried);
}

// Once the first effect, clipping, was taken out of the samples.
std::optional<Attempt> AfterRepair(const Setting& whole, const Attempt& first,
                                   const std::vector<EffectForms>& units,
                                   const std::vector<CoherentLine>& lines, int threads) {
  std::vector<CutRecord> records = MakeCutRecords(first.repaired);
  KeepReference(*whole.records, &records);
  MaskLines(lines, &records);
  const EffectFit base = FitBase(records);
  Setting at{&records, &base, &first.repaired, {}, nullptr, whole.reference};
  for (std::size_t e = 0; e < records.size(); ++e) {
    at.base_held_out.push_back(HeldOut(records, base, e));
  }
  const bool pressure = first.candidate.block == LoopBlock::kPressureInstrument;
  if (pressure) {
    std::optional<Attempt> gain = BestGain(at, base, units);
    if (gain && gain->candidate.gain > LeastSecond(first)) return Join(first, std::move(*gain));
  }
  std::vector<std::optional<Attempt>> tried(units.size());
  RunUnits(units.size(), threads, [&](std::size_t i) {
    const Effect& effect = *units[i][0];
    if (effect.kind() != EffectKind::kTransfer) return;
    if (pressure || effect.ChangesAcousticCut()) tried[i] = TryTransfer(at, units[i]);
  });
  std::optional<Attempt> best = Best(&tried);
  const double share = pressure ? kAfterPressureRepairShare : kAfterHeatReleaseRepairShare;
  // Slack that is left in cut A tells how rough the repair is.
  const double least = std::max({kAfterRepairGain, share * first.candidate.gain,
                                 ComputeSlack(records, base).acoustic_excess});
  if (!best || best->candidate.gain < least) return std::nullopt;
  return Join(first, std::move(*best));
}

// What fluctuates once the transfer function is right.
std::optional<Attempt> WithFluctuation(const Setting& at, const Attempt& transfer,
                                       const std::vector<EffectForms>& units) {
  std::optional<Attempt> best = BestGain(at, *transfer.fit, units);
  if (!best || best->candidate.gain < LeastSecond(transfer)) return std::nullopt;
  for (std::size_t e = 0; e < best->held_out.size(); ++e) {
    best->held_out[e].acoustic_residual = transfer.held_out[e].acoustic_residual;
  }
  Attempt joined = Join(transfer, std::move(*best));
  joined.fit = transfer.fit;
  return joined;
}

// A clipped q is no wrong input to the flame, and Phi takes its flat top for saturation: cut B is
// right as it is, and tells of the flame and the delay.
std::optional<Attempt> BesideClippedHeatRelease(const Attempt& first,
                                                const std::vector<Attempt>& attempts) {
  const Attempt* other = BestOf(attempts, [](const Attempt& attempt) {
    return (IsGain(attempt) || IsTransfer(attempt)) && !ChangesAcousticCut(attempt);
  });
  if (!other || other->candidate.gain < DetectionGain(true)) return std::nullopt;
  Attempt joined = Join(first, *other);
  for (std::size_t e = 0; e < joined.held_out.size(); ++e) {
    joined.held_out[e].acoustic_residual = first.held_out[e].acoustic_residual;
  }
  return joined;
}

}  // namespace

std::optional<Attempt> TryDistinctPair(const Setting& at, const std::vector<Attempt>& attempts,
                                       const std::vector<EffectForms>& units,
                                       const std::vector<CoherentLine>& lines, int threads) {
  if (attempts.empty()) return std::nullopt;
  const Attempt& top = attempts[0];
  const Attempt* line = BestOf(attempts, IsLine);
  if (line && line->candidate.gain > DetectionGain(false)) {
    const Attempt* other = BestOf(attempts, [](const Attempt& a) { return !IsLine(a); });
    if (other && Detected(*other)) return Join(*line, *other);
    return std::nullopt;
  }
  if (top.seen) {
    if (!top.repaired.empty()) {
      if (top.candidate.block == LoopBlock::kHeatReleaseInstrument) {
        std::optional<Attempt> pair = BesideClippedHeatRelease(top, attempts);
        if (pair) return pair;
      }
      return AfterRepair(at, top, units, lines, threads);
    }
    // Steps in p disturb every fit: nothing but a line stands beside them.
    return std::nullopt;
  }
  if (IsGain(top)) {
    const double beside =
        std::max(kBesideFluctuationGain, kBesideFluctuationShare * top.candidate.gain);
    const Attempt* other = BestOf(attempts, [&](const Attempt& attempt) {
      return IsTransfer(attempt) &&
             attempt.candidate.gain >= (ChangesAcousticCut(attempt) ? LeastSecond(top) : beside);
    });
    return other ? WithFluctuation(at, *other, units) : std::nullopt;
  }
  return IsTransfer(top) ? WithFluctuation(at, top, units) : std::nullopt;
}

std::optional<Attempt> TryTransferPair(const Setting& at, const Attempt& first,
                                       const std::vector<EffectForms>& units, int threads) {
  if (!IsTransfer(first)) return std::nullopt;
  std::vector<std::optional<Attempt>> tried(units.size());
  RunUnits(units.size(), threads, [&](std::size_t i) {
    const EffectForms& forms = units[i];
    if (forms[0]->kind() != EffectKind::kTransfer || forms[0]->id() == first.fit->effect->id()) {
      return;
    }
    EffectForms combined;
    for (const EffectPointer& form : forms) combined.push_back(Combine(first.fit->effect, form));
    tried[i] = TryTransfer(at, combined, &*first.fit);
  });
  std::optional<Attempt> best = Best(&tried);
  const double least = std::max(kSecondGain, kCompetingShare * first.candidate.gain);
  if (!best || best->candidate.gain - first.candidate.gain < least) return std::nullopt;
  return best;
}

}  // namespace howl
