#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "diagnosis/gap/gap_map.h"
#include "diagnosis/localise/localise.h"
#include "diagnosis/localise/place.h"
#include "diagnosis/search/search.h"
#include "diagnosis/search/second_effect.h"
#include "diagnosis/verdict/advice.h"
#include "diagnosis/verdict/calibration.h"

namespace howl {
namespace {

// Where a second transfer function brings as much as it must, the fit of the first alone leaves at
// least this share of that as slack (results/trial). With less slack the search does not pay.
constexpr double kSlackOfASecond = 0.3;

bool LeavesRoomForASecond(const Attempt& first, const Slack& after) {
  return !first.model_free && !first.also &&
         after.acoustic_excess + after.flame_excess > kSlackOfASecond * LeastCompeting(first);
}

bool Better(const Attempt& a, const Attempt& b) {
  return a.model_free != b.model_free ? a.model_free : a.candidate.gain > b.candidate.gain;
}

}  // namespace

Diagnosis Search::Run() {
  TryAll();
  double own_delays_gain = std::numeric_limits<double>::quiet_NaN();
  if (options_.choose_delays && !reference_ && !Stopped()) {
    own_delays_gain = OwnDelaysGain();
    if (DelaysDiffer(own_delays_gain)) {
      Diagnosis differ;
      differ.own_delays_gain = own_delays_gain;
      return differ;
    }
  }
  if (options_.bootstrap > 0 && !Stopped()) Bootstrap();
  if (Stopped() || options_.owns_replicate) {
    Diagnosis unfinished;
    unfinished.stopped = true;
    return unfinished;
  }
  MeasureGaps();
  std::stable_sort(attempts_.begin(), attempts_.end(), Better);
  gain_of_noise_ = GainOfNoiseForTheBest();
  Judgement at = Judge();
  Diagnosis out = Conclude(at.evidence, at.belief);
  out.own_delays_gain = own_delays_gain;
  Describe(at, &out);
  if (at.together) {
    MeasureGap(&*at.together);
    at.together->candidate.probability = 0.0;
    out.together = at.together->candidate.effect;
    attempts_.insert(attempts_.begin() + 1, std::move(*at.together));
  }
  const bool model_free =
      !attempts_.empty() && (attempts_[0].model_free || attempts_[0].without_lines);
  out.candidates = Candidates();
  out.advice = Advice(out, model_free);
  Calibrate(DoubtOfOneCause(out.kind, model_free), &out);
  return out;
}

Search::Judgement Search::Judge() {
  Judgement at;
  at.evidence = Look(attempts_.empty() ? nullptr : &attempts_[0], &at.after);
  at.belief = Weigh(at.evidence);
  if (at.belief.none < 0.5 && !at.evidence.model_free) {
    std::vector<Attempt> combined = BesideALine(attempts_);
    if (!combined.empty()) {
      const double p_value = attempts_[0].candidate.p_value;
      for (Attempt& each : combined) {
        each.candidate.p_value = p_value;
        MeasureGap(&each);
      }
      attempts_.insert(attempts_.begin(), std::make_move_iterator(combined.begin()),
                       std::make_move_iterator(combined.end()));
      at.evidence = Look(&attempts_[0], &at.after);
      at.belief = Weigh(at.evidence);
    }
  }
  if (at.belief.none < 0.5 && !attempts_.empty() && Detected() &&
      (at.belief.unknown > 0.5 || LeavesRoomForASecond(attempts_[0], at.after))) {
    at.together = TryTransferPair(at_, attempts_[0], units_, options_.threads);
    if (at.together) at.belief.unknown = std::max(at.belief.unknown, kUnexplainedFact);
  }
  if (at.belief.none <= 0.5 && !attempts_.empty()) {
    at.placebo_shrinkage = PlaceboShrinkage(attempts_[0]);
    if (IsNoBetterThanPlacebo(attempts_[0].candidate.shrinkage, at.placebo_shrinkage)) {
      at.belief.unknown = std::max(at.belief.unknown, kUnexplainedFact);
    }
  }
  return at;
}

void Search::Describe(const Judgement& at, Diagnosis* out) {
  out->bootstrap_gains = bootstrap_gains_;
  out->slack_acoustic_before = slack_before_.acoustic_excess;
  out->slack_flame_before = slack_before_.flame_excess;
  out->slack_acoustic_after = at.after.acoustic_excess;
  out->slack_flame_after = at.after.flame_excess;
  out->placebo_shrinkage = at.placebo_shrinkage;
  const bool no_lines = lines_.empty();
  GapSide left;
  if (!attempts_.empty()) {
    left = {&attempts_[0].held_out, no_lines || attempts_[0].without_lines};
  }
  out->map = GapMap(records_, {&at_.base_held_out, no_lines}, left, flame_noise_);
  if (out->kind != VerdictKind::kNone) {
    std::vector<BlockSlack> blocks;
    if (out->kind == VerdictKind::kUnknown) {
      blocks = Localise(at_, lines_, origin_, fluctuation_, options_.threads);
    }
    out->where = FindPlaces(records_, attempts_, out->kind, slack_before_, blocks);
  }
  const bool best_is_fitted = out->kind == VerdictKind::kEffect && attempts_[0].fit.has_value();
  out->model = records_[0].model;
  out->delay_scatter = best_is_fitted ? attempts_[0].fit->delay_scatter : base_.delay_scatter;
  if (best_is_fitted) {
    out->base_parameters = MovedParameters(records_, base_, *attempts_[0].fit);
  }
}

std::vector<Candidate> Search::Candidates() const {
  std::vector<Candidate> out;
  for (const Attempt& attempt : attempts_) out.push_back(attempt.candidate);
  return out;
}

bool Search::Detected() const {
  const Attempt& top = attempts_[0];
  return top.candidate.gain > DetectionGain(ShowsInFlameAlone(top));
}

Diagnosis Search::Conclude(const Evidence& evidence, const Belief& belief) {
  Diagnosis out;
  out.gap_before = evidence.gap_before;
  out.gap_after = evidence.gap_before;
  out.gap_floor = evidence.gap_floor;
  out.probability_none = belief.none;
  out.probability_unknown = (1.0 - belief.none) * belief.unknown;
  // The odds of a pair against its first effect alone depend on the gain of the second.
  const double temperature = Temperature(
      !attempts_.empty() && attempts_[0].also ? attempts_[0].second_gain : evidence.gain);
  std::vector<double> weight;
  double total = 0.0;
  for (const Attempt& attempt : attempts_) {
    const double behind = attempts_[0].candidate.gain - attempt.candidate.gain;
    // If the best was detected in the samples, no other single effect can replace it.
    const bool out_of_question = attempts_[0].model_free && !weight.empty();
    weight.push_back(out_of_question ? 0.0 : std::exp(-behind / temperature));
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

}  // namespace howl
