#include <algorithm>
#include <limits>
#include <string>

#include "diagnosis/search/search.h"
#include "diagnosis/verdict/placebo.h"
#include "estimation/analysis/spectra/statistics.h"
#include "estimation/parallel.h"
#include "model/noise/random_stream.h"

namespace howl {
namespace {

constexpr std::size_t kPlaceboDraws = 11;
constexpr std::uint64_t kPlaceboSeed = 20;

}  // namespace

void Search::MeasureGaps() {
  for (const ExperimentFit& fit : base_.experiments) flame_noise_.push_back(fit.flame_noise);
  double least = base_.flame_cost;
  for (const Attempt& attempt : attempts_) {
    if (!attempt.fit || attempt.fit->flame_cost >= least) continue;
    least = attempt.fit->flame_cost;
    for (std::size_t e = 0; e < records_.size(); ++e) {
      flame_noise_[e] = attempt.fit->experiments[e].flame_noise;
    }
  }
  gap_before_ = ComputeGapParts(records_, at_.base_held_out, flame_noise_, lines_.empty());
  for (Attempt& attempt : attempts_) MeasureGap(&attempt);
}

void Search::MeasureGap(Attempt* attempt) const {
  const GapParts after = ComputeGapParts(records_, attempt->held_out, flame_noise_,
                                         lines_.empty() || attempt->without_lines);
  Candidate& candidate = attempt->candidate;
  candidate.gap_after = Gap(after);
  candidate.shrinkage = 1.0 - candidate.gap_after / std::max(Gap(gap_before_), 1e-12);
  const ConfidenceInterval interval = ShrinkageInterval(gap_before_, after);
  candidate.shrinkage_low = interval.low;
  candidate.shrinkage_high = interval.high;
}

double Search::PlaceboShrinkage(const Attempt& best) const {
  if (!best.fit || best.also) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Effect& effect = *best.fit->effect;
  std::vector<double> shrinkage(kPlaceboDraws);
  RunUnits(shrinkage.size(), options_.threads, [&](std::size_t i) {
    Attempt attempt =
        // The name under which stored states of interrupted runs know the placebos' fits.
        TryTransfer(at_, "no_meaning." + std::to_string(i),
                    {PlaceboEffect(effect.parameters().size(), effect.ChangesAcousticCut(),
                                   effect.ChangesFlameCut(), DeriveSeed(kPlaceboSeed, i))});
    MeasureGap(&attempt);
    shrinkage[i] = attempt.candidate.shrinkage;
  });
  return MedianInPlace(shrinkage);
}

Evidence Search::Look(const Attempt* top, Slack* after) const {
  EffectFit best = base_;
  if (top) {
    if (top->fit) best = *top->fit;
    if (!top->fit || top->kind != EffectKind::kTransfer) {
      for (std::size_t e = 0; e < records_.size(); ++e) {
        best.experiments[e].acoustic_residual = top->held_out[e].acoustic_residual;
        best.experiments[e].flame_residual = top->held_out[e].flame_residual;
      }
    }
  }
  *after = ComputeSlack(records_, best);
  Evidence out;
  out.acoustic_slack = after->acoustic_excess;
  out.flame_slack = after->flame_excess;
  out.gap_before = Gap(gap_before_);
  out.gap_floor = GapFloor(records_);
  if (reference_) out.gap_floor = std::max(out.gap_floor, reference_->gap_floor);
  // Lines that no candidate accounts for are a fact, whatever else fits.
  out.unexplained_lines =
      !lines_.empty() &&
      std::none_of(attempts_.begin(), attempts_.end(), [](const Attempt& attempt) {
        return attempt.without_lines && attempt.candidate.gain > DetectionGain(false);
      });
  out.unexplained_samples =
      (ShowsLimits(at_, Channel::kPressure) || ShowsLimits(at_, Channel::kHeatRelease)) &&
      std::none_of(attempts_.begin(), attempts_.end(), [](const Attempt& attempt) {
        return attempt.model_free || (attempt.kind == EffectKind::kDeclaredMap &&
                                      attempt.candidate.gain > DetectionGain(false));
      });
  out.gain_of_noise = gain_of_noise_;
  if (!top) return out;
  out.gain = std::max(0.0, top->candidate.gain);
  out.gap_after = top->candidate.gap_after;
  out.model_free = top->model_free;
  out.form_is_wrong = top->fit && !top->fit->effect->IsOwnCause(top->fit->values);
  out.confirmed = top->confirmed;
  out.flame_alone = ShowsInFlameAlone(*top);
  return out;
}

}  // namespace howl
