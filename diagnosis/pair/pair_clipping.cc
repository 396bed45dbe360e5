#include <algorithm>
#include <utility>

#include "diagnosis/pair/pair_parts.h"
#include "diagnosis/verdict/verdict.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

// Transfer functions of the acoustics in the records from which q's clipping was taken out: p alone
// tells of the samples that were lost, so that these are put back roughly.
std::vector<Attempt> AfterRepair(const AttemptContext& whole, const Attempt& first,
                                 const std::vector<EffectForms>& units,
                                 const std::vector<CoherentLine>& lines, int threads) {
  const std::vector<CutRecord> records = RemakeCutRecords(first.repaired, *whole.records, lines);
  const EffectFit base = FitBase(records);
  const AttemptContext at{&records, &base,          &first.repaired, HoldOutEach(records, base),
                          nullptr,  whole.reference};
  std::vector<std::optional<Attempt>> tried(units.size());
  RunUnits(units.size(), threads, [&](std::size_t i) {
    const Effect& effect = *units[i][0];
    if (effect.kind() != EffectKind::kTransfer) return;
    if (effect.ChangesAcousticCut()) tried[i] = TryTransfer(at, "", units[i]);
  });
  std::vector<Attempt> best = NearBestPaid(std::move(tried));
  // A form that is no cause of its own, such as a second extra mode, corrects the repair's errors.
  if (best.empty() || !best[0].fit->effect->IsOwnCause(best[0].fit->values)) return {};
  if (best[0].candidate.gain < LeastSecond(first)) return {};
  return best;
}

// Of cut B alone, in which Phi takes the clipped top for saturation.
std::vector<Attempt> InFlameCut(const Attempt& first, const std::vector<Attempt>& attempts,
                                double least) {
  std::vector<Attempt> best = NearBestOf(attempts, [](const Attempt& attempt) {
    return (IsGain(attempt) || IsTransfer(attempt)) && !ChangesAcousticCut(attempt);
  });
  if (best.empty() || best[0].candidate.gain < least) return {};
  for (Attempt& each : best) {
    for (std::size_t e = 0; e < each.held_out.size(); ++e) {
      each.held_out[e].acoustic_residual = first.held_out[e].acoustic_residual;
    }
  }
  return best;
}

}  // namespace

std::vector<Attempt> SecondsGivenClipping(const AttemptContext& at,
                                          const std::vector<Attempt>& attempts,
                                          const std::vector<EffectForms>& units,
                                          const std::vector<CoherentLine>& lines, int threads) {
  const Attempt& first = attempts[0];
  const double least = std::max(DetectionGain(true), NoiseGivenReference(at));
  std::vector<Attempt> seconds = InFlameCut(first, attempts, least);
  // Clipping and its repair are alike in all periods, and imitate no fluctuation.
  if (!seconds.empty() && IsGain(seconds[0])) return JoinAll(first, std::move(seconds));
  if (seconds.empty()) seconds = AfterRepair(at, first, units, lines, threads);
  if (seconds.empty()) return {};
  Attempt both = Join(first, std::move(seconds[0]));
  both.may_be_spurious = true;
  return {first, std::move(both)};
}

}  // namespace howl
