#include "diagnosis/diagnosis.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "diagnosis/advice.h"
#include "diagnosis/calibration.h"
#include "diagnosis/candidates/attempt.h"
#include "diagnosis/gap.h"
#include "diagnosis/gap_map.h"
#include "diagnosis/localise/localise.h"
#include "diagnosis/no_meaning.h"
#include "diagnosis/pair.h"
#include "diagnosis/place.h"
#include "diagnosis/reference.h"
#include "diagnosis/slack.h"
#include "diagnosis/verdict.h"
#include "estimation/parallel.h"
#include "model/random_stream.h"

namespace howl {
namespace {

constexpr double kClassProbability = 0.05;
constexpr std::size_t kNoMeaningDraws = 3;
constexpr std::uint64_t kNoMeaningSeed = 20;

// One unit of work for each identifier, whatever its forms.
std::vector<EffectForms> Units(const DiagnosisOptions& options) {
  std::vector<EffectForms> units;
  std::vector<EffectPointer> all = Catalogue();
  all.insert(all.end(), options.further.begin(), options.further.end());
  for (const EffectPointer& effect : all) {
    const std::string id(effect->id());
    if (std::find(options.withheld.begin(), options.withheld.end(), id) != options.withheld.end()) {
      continue;
    }
    if (!units.empty() && units.back()[0]->id() == effect->id()) {
      units.back().push_back(effect);
    } else {
      units.push_back({effect});
    }
  }
  return units;
}

// Starts of the search over all forms.
std::size_t WorkOf(const EffectForms& forms) {
  std::size_t work = 0;
  for (const EffectPointer& form : forms) {
    std::size_t starts = 1;
    for (const EffectParameter& p : form->parameters()) {
      starts *= std::max<std::size_t>(p.starts.size(), 1);
    }
    work += starts;
  }
  return work;
}

class Search {
 public:
  Search(const std::vector<DiagnosisExperiment>& experiments, const DiagnosisOptions& options)
      : options_(options), units_(Units(options)), records_(MakeCutRecords(experiments)) {
    lines_ = FindCoherentLines(records_);
    MaskLines(lines_, &records_);
    if (!options.reference.empty()) {
      reference_ = AbsorbReference(options.reference, experiments, &records_);
      lines_ = NewLines(lines_, reference_->lines);
    }
    base_ = FitBase(records_);
    if (!reference_) TakeLinesLeftOver();
    at_ = {&records_, &base_,         &experiments,
           {},        options.memory, reference_ ? &*reference_ : nullptr};
    for (std::size_t e = 0; e < records_.size(); ++e) {
      at_.base_held_out.push_back(HeldOut(records_, base_, e));
    }
    slack_before_ = ComputeSlack(records_, base_);
  }

  Diagnosis Run() {
    TryAll();
    if (Stopped()) {
      Diagnosis unfinished;
      unfinished.stopped = true;
      return unfinished;
    }
    MeasureGaps();
    std::stable_sort(attempts_.begin(), attempts_.end(), Better);
    Slack after;
    Evidence evidence = Look(attempts_.empty() ? nullptr : &attempts_[0], &after);
    Belief belief = Weigh(evidence);
    if (belief.none < 0.5) {
      if (std::optional<Attempt> pair =
              TryDistinctPair(at_, attempts_, units_, lines_, options_.threads)) {
        pair->candidate.p_value = attempts_[0].candidate.p_value;
        MeasureGap(&*pair);
        attempts_.insert(attempts_.begin(), std::move(*pair));
        evidence = Look(&attempts_[0], &after);
        belief = Weigh(evidence);
      }
    }
    Diagnosis out = Conclude(evidence, belief);
    out.slack_acoustic_before = slack_before_.acoustic_excess;
    out.slack_flame_before = slack_before_.flame_excess;
    out.slack_acoustic_after = after.acoustic_excess;
    out.slack_flame_after = after.flame_excess;
    out.map =
        GapMap(records_, at_.base_held_out, attempts_.empty() ? nullptr : &attempts_[0].held_out,
               flame_noise_, lines_.empty());
    if (out.kind != VerdictKind::kNone) {
      std::vector<BlockSlack> blocks;
      if (out.kind == VerdictKind::kUnknown) {
        blocks = Localise(at_, lines_, origin_, fluctuation_, options_.threads);
      }
      out.where = FindPlaces(records_, attempts_, out.kind, slack_before_, blocks);
    }
    if (out.kind != VerdictKind::kNone && !attempts_.empty()) {
      out.shrinkage_no_meaning = ShrinkageByNoMeaning(attempts_[0]);
    }
    if (out.kind == VerdictKind::kUnknown && !attempts_.empty() && Detected()) {
      if (std::optional<Attempt> pair =
              TryTransferPair(at_, attempts_[0], units_, options_.threads)) {
        MeasureGap(&*pair);
        pair->candidate.probability = 0.0;
        out.together = pair->candidate.effect;
        attempts_.insert(attempts_.begin() + 1, std::move(*pair));
      }
    }
    out.advice = Advice(out);
    const bool seen = !attempts_.empty() && (attempts_[0].seen || attempts_[0].without_lines);
    for (Attempt& attempt : attempts_) out.candidates.push_back(std::move(attempt.candidate));
    Calibrate(seen, &out);
    return out;
  }

 private:
  void TakeLinesLeftOver() {
    const std::vector<CoherentLine> left = FindLinesLeftOver(records_, base_);
    if (left.empty()) return;
    MaskLines(left, &records_);
    lines_.insert(lines_.end(), left.begin(), left.end());
    base_ = FitBase(records_);
  }

  static bool Better(const Attempt& a, const Attempt& b) {
    return a.seen != b.seen ? a.seen : a.candidate.gain > b.candidate.gain;
  }

  bool Detected() const {
    const Attempt& top = attempts_[0];
    const bool flame_alone = top.fit && !top.fit->effect->ChangesAcousticCut();
    return top.candidate.gain > DetectionGain(flame_alone);
  }

  bool Stopped() const { return options_.stopped && options_.stopped(); }

  void TryAll() {
    origin_ = ExplainLines(records_, base_, lines_);
    fluctuation_ = EstimateGainFluctuation(records_, base_);
    if (reference_) {
      fluctuation_.gain = std::max(0.0, fluctuation_.gain - reference_->fluctuation_gain);
    }
    attempts_.resize(units_.size());
    std::size_t work = 0;
    for (const EffectForms& unit : units_) work += WorkOf(unit);
    std::atomic<std::size_t> done = 0;
    std::mutex progress_lock;
    RunUnits(units_.size(), options_.threads, [&](std::size_t i) {
      if (Stopped()) return;
      attempts_[i] = Try(units_[i]);
      const std::size_t now = done += WorkOf(units_[i]);
      if (options_.progress) {
        const std::lock_guard<std::mutex> lock(progress_lock);
        options_.progress(now, work);
      }
    });
    for (Attempt& attempt : attempts_) {
      attempt.candidate.p_value = PValue(attempt.candidate.gain, attempt.parameters, units_.size());
      PayForParameters(&attempt);
    }
  }

  Attempt Try(const EffectForms& forms) const {
    const Effect& effect = *forms[0];
    switch (effect.kind()) {
      case EffectKind::kTransfer:
        return TryTransfer(at_, forms);
      case EffectKind::kGain:
        return TryGain(at_, effect, fluctuation_);
      case EffectKind::kLine:
        return TryLines(at_, effect, lines_, origin_);
      case EffectKind::kClipping:
        return TryClipping(at_, effect);
      case EffectKind::kDeclaredMap:
        return TryDeclaredMap(at_, dynamic_cast<const DeclaredEffect&>(effect));
      case EffectKind::kDeclaredLine:
        return TryDeclaredLine(at_, dynamic_cast<const DeclaredEffect&>(effect), lines_);
      case EffectKind::kQuantisation:
        break;
    }
    return TryQuantisation(at_, effect);
  }

  // V_B of the gap: the least that any fit leaves over.
  void MeasureGaps() {
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

  void MeasureGap(Attempt* attempt) const {
    const GapParts after = ComputeGapParts(records_, attempt->held_out, flame_noise_,
                                           lines_.empty() || attempt->without_lines);
    Candidate& candidate = attempt->candidate;
    candidate.gap_after = Gap(after);
    candidate.shrinkage = 1.0 - candidate.gap_after / std::max(Gap(gap_before_), 1e-12);
    const Interval interval = ShrinkageInterval(gap_before_, after);
    candidate.shrinkage_low = interval.low;
    candidate.shrinkage_high = interval.high;
  }

  double ShrinkageByNoMeaning(const Attempt& best) const {
    if (!best.fit || best.also || !best.repaired.empty()) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const Effect& effect = *best.fit->effect;
    std::vector<double> shrinkage(kNoMeaningDraws);
    RunUnits(shrinkage.size(), options_.threads, [&](std::size_t i) {
      Attempt attempt =
          TryTransfer(at_, {NoMeaning(effect.parameters().size(), effect.ChangesAcousticCut(),
                                      effect.ChangesFlameCut(), DeriveSeed(kNoMeaningSeed, i))});
      MeasureGap(&attempt);
      shrinkage[i] = attempt.candidate.shrinkage;
    });
    double mean = 0.0;
    for (const double each : shrinkage) mean += each / static_cast<double>(kNoMeaningDraws);
    return mean;
  }

  Evidence Look(const Attempt* top, Slack* after) const {
    EffectFit best = base_;
    if (top) {
      if (top->fit && top->repaired.empty()) best = *top->fit;
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
    if (!top) return out;
    out.gain = std::max(0.0, top->candidate.gain);
    out.gap_after = top->candidate.gap_after;
    out.seen = top->seen;
    out.confirmed = top->confirmed;
    out.flame_alone = top->fit && !top->fit->effect->ChangesAcousticCut();
    return out;
  }

  Diagnosis Conclude(const Evidence& evidence, const Belief& belief) {
    Diagnosis out;
    out.gap_before = evidence.gap_before;
    out.gap_after = evidence.gap_before;
    out.gap_floor = evidence.gap_floor;
    out.probability_none = belief.none;
    out.probability_unknown = (1.0 - belief.none) * belief.unknown;
    // Against the first of a pair alone, what counts is what the second brings.
    const double temperature = Temperature(
        !attempts_.empty() && attempts_[0].also ? attempts_[0].second_gain : evidence.gain);
    std::vector<double> weight;
    double total = 0.0;
    for (const Attempt& attempt : attempts_) {
      const double behind = attempts_[0].candidate.gain - attempt.candidate.gain;
      // What is seen in the samples leaves no room for another.
      weight.push_back(attempts_[0].seen ? (weight.empty() ? 1.0 : 0.0)
                                         : std::exp(-behind / temperature));
      total += weight.back();
    }
    for (std::size_t i = 0; i < attempts_.size(); ++i) {
      attempts_[i].candidate.probability =
          (1.0 - belief.none) * (1.0 - belief.unknown) * weight[i] / total;
    }
    if (belief.none > 0.5) return out;
    if (!attempts_.empty()) {
      out.gap_after = std::min(attempts_[0].candidate.gap_after, evidence.gap_before);
    }
    if (belief.unknown > 0.5 || attempts_.empty()) {
      out.kind = VerdictKind::kUnknown;
      return out;
    }
    const Candidate& top = attempts_[0].candidate;
    out.kind = VerdictKind::kEffect;
    out.effect = top.effect;
    for (std::size_t i = 1; i < attempts_.size(); ++i) {
      if (attempts_[i].candidate.probability > kClassProbability * top.probability) {
        out.indistinguishable.push_back(attempts_[i].candidate.effect);
      }
    }
    return out;
  }

  const DiagnosisOptions& options_;
  std::vector<EffectForms> units_;
  std::vector<CutRecord> records_;
  std::vector<CoherentLine> lines_;
  std::optional<ReferenceModel> reference_;
  EffectFit base_;
  Setting at_;
  Slack slack_before_;
  LineOrigin origin_;
  GainFluctuation fluctuation_;
  std::vector<Attempt> attempts_;
  std::vector<Eigen::VectorXd> flame_noise_;
  GapParts gap_before_;
};

}  // namespace

Diagnosis Diagnose(const std::vector<DiagnosisExperiment>& experiments,
                   const DiagnosisOptions& options) {
  return Search(experiments, options).Run();
}

}  // namespace howl
