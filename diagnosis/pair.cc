#include "diagnosis/pair.h"

#include <algorithm>
#include <string>
#include <utility>

#include "diagnosis/verdict.h"
#include "estimation/parallel.h"
#include "model/effects/combined.h"

namespace howl {
namespace {

// What a second effect must bring beyond the least for a first: the first's form is never exact.
constexpr double kSecondGain = 60.0;
constexpr double kSecondShare = 0.02;            // of what the first brought
constexpr double kAfterRepairShare = 0.25;       // a repair is rough
constexpr double kBesideFluctuationShare = 0.3;  // a fluctuating gain disturbs every other fit
constexpr double kBesideFluctuationGain = 100.0;

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

// The best transfer function once the first effect was taken out of the samples.
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
  std::vector<std::optional<Attempt>> tried(units.size());
  RunUnits(units.size(), threads, [&](std::size_t i) {
    const Effect& effect = *units[i][0];
    // The repair shows in the flame's answer too; in cut A it was fitted.
    if (effect.kind() != EffectKind::kTransfer || !effect.ChangesAcousticCut()) return;
    tried[i] = TryTransfer(at, units[i]);
  });
  std::optional<Attempt> best = Best(&tried);
  const double least = std::max(kSecondGain, kAfterRepairShare * first.candidate.gain);
  if (!best || best->candidate.gain < least) return std::nullopt;
  return Join(first, std::move(*best));
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
    if (!top.repaired.empty()) return AfterRepair(at, top, units, lines, threads);
    // Steps in p disturb every fit: nothing but a line stands beside them.
    return std::nullopt;
  }
  if (IsGain(top)) {
    const Attempt* other = BestOf(attempts, IsTransfer);
    const double least =
        std::max(kBesideFluctuationGain, kBesideFluctuationShare * top.candidate.gain);
    if (!other || other->candidate.gain < least) return std::nullopt;
    Attempt joined = Join(top, *other);
    return joined;
  }
  if (!IsTransfer(top)) return std::nullopt;
  // What fluctuates once the transfer function is right.
  const GainFluctuation fluctuation = EstimateGainFluctuation(*at.records, *top.fit);
  std::vector<std::optional<Attempt>> tried;
  for (const EffectForms& forms : units) {
    if (forms[0]->kind() == EffectKind::kGain) tried.push_back(TryGain(at, *forms[0], fluctuation));
  }
  std::optional<Attempt> best = Best(&tried);
  if (!best) return std::nullopt;
  if (best->candidate.gain < std::max(kSecondGain, kSecondShare * top.candidate.gain)) {
    return std::nullopt;
  }
  for (std::size_t e = 0; e < best->held_out.size(); ++e) {
    best->held_out[e].acoustic_residual = top.held_out[e].acoustic_residual;
  }
  Attempt joined = Join(top, std::move(*best));
  joined.fit = top.fit;
  return joined;
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
  const double least = std::max(kSecondGain, kSecondShare * first.candidate.gain);
  if (!best || best->candidate.gain - first.candidate.gain < least) return std::nullopt;
  return best;
}

}  // namespace howl
