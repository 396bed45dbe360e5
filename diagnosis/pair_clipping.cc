#include <algorithm>
#include <utility>

#include "diagnosis/pair_parts.h"
#include "diagnosis/slack.h"
#include "diagnosis/verdict.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

// Clipped samples are put back roughly, those of q more so: p tells of them through cut A alone.
constexpr double kAfterRepairGain = 60.0;
constexpr double kAfterPressureRepairShare = 0.016;
constexpr double kAfterHeatReleaseRepairShare = 0.4;

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
  std::optional<Attempt> best = BestPaid(&tried);
  const double share = pressure ? kAfterPressureRepairShare : kAfterHeatReleaseRepairShare;
  // Slack that is left in cut A tells how rough the repair is.
  const double least = std::max({kAfterRepairGain, share * first.candidate.gain,
                                 ComputeSlack(records, base).acoustic_excess});
  if (!best || best->candidate.gain < least) return std::nullopt;
  return Join(first, std::move(*best));
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

std::optional<Attempt> BesideClipping(const Setting& at, const std::vector<Attempt>& attempts,
                                      const std::vector<EffectForms>& units,
                                      const std::vector<CoherentLine>& lines, int threads) {
  const Attempt& clipped = attempts[0];
  if (clipped.candidate.block == LoopBlock::kHeatReleaseInstrument) {
    std::optional<Attempt> pair = BesideClippedHeatRelease(clipped, attempts);
    if (pair) return pair;
  }
  return AfterRepair(at, clipped, units, lines, threads);
}

}  // namespace howl
