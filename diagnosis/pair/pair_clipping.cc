#include <algorithm>
#include <utility>

#include "diagnosis/gap/slack.h"
#include "diagnosis/pair/pair_parts.h"
#include "diagnosis/verdict/verdict.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

// Clipped samples of q are declipped roughly, because p tells of them through cut A alone. A second
// effect must bring more than the errors of that repair may.
constexpr double kAfterRepairGain = 60.0;
constexpr double kAfterRepairShare = 0.4;

// Second effects in the records from which q's clipping was taken out.
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
  // Slack that is left in cut A measures how rough the repair is.
  const double least = std::max({kAfterRepairGain, kAfterRepairShare * first.candidate.gain,
                                 ComputeSlack(records, base).acoustic_excess});
  if (best[0].candidate.gain >= least) return JoinAll(first, std::move(best));
  if (best[0].candidate.gain < LeastSecond(first)) return {};
  Attempt both = Join(first, std::move(best[0]));
  both.may_be_spurious = true;
  return {first, std::move(both)};
}

// Cut B stays right with a clipped q, because q is not the flame's input, and Phi takes the clipped
// top for saturation. Second effects in the flame and the delay are therefore found in cut B.
std::vector<Attempt> SecondsGivenClippedHeatRelease(const Attempt& first,
                                                    const std::vector<Attempt>& attempts,
                                                    double least) {
  std::vector<Attempt> others = NearBestOf(attempts, [](const Attempt& attempt) {
    return (IsGain(attempt) || IsTransfer(attempt)) && !ChangesAcousticCut(attempt);
  });
  if (others.empty() || others[0].candidate.gain < least) return {};
  for (Attempt& other : others) {
    for (std::size_t e = 0; e < other.held_out.size(); ++e) {
      other.held_out[e].acoustic_residual = first.held_out[e].acoustic_residual;
    }
  }
  return JoinAll(first, std::move(others));
}

}  // namespace

std::vector<Attempt> SecondsGivenClipping(const AttemptContext& at,
                                          const std::vector<Attempt>& attempts,
                                          const std::vector<EffectForms>& units,
                                          const std::vector<CoherentLine>& lines, int threads) {
  const double least = std::max(DetectionGain(true), NoiseGivenReference(at));
  std::vector<Attempt> pairs = SecondsGivenClippedHeatRelease(attempts[0], attempts, least);
  return pairs.empty() ? AfterRepair(at, attempts[0], units, lines, threads) : pairs;
}

}  // namespace howl
