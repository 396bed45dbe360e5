#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "diagnosis/declip/declip.h"
#include "diagnosis/localise/place.h"
#include "diagnosis/pair/pair_parts.h"
#include "diagnosis/samples/sample_limits.h"
#include "diagnosis/search/search.h"
#include "estimation/parallel.h"
#include "model/effects/combined.h"

namespace howl {
namespace {

constexpr int kMostDeclippings = 10;
constexpr double kConvergedGain = 0.5;  // change of log-likelihood below which it ends

void SetPressures(const std::vector<Eigen::VectorXd>& pressures,
                  std::vector<DiagnosisExperiment>* experiments) {
  for (std::size_t e = 0; e < pressures.size(); ++e) {
    Record& record = (*experiments)[e].record;
    record.pressure.assign(pressures[e].data(), pressures[e].data() + pressures[e].size());
    record.heat_release.resize(record.pressure.size());
  }
}

double MeanFraction(const std::vector<CutRecord>& recorded, const std::vector<CutRecord>& whole) {
  double sum = 0.0;
  for (std::size_t e = 0; e < recorded.size(); ++e) {
    const double rms = whole[e].pressure.norm() / std::sqrt(static_cast<double>(whole[e].samples));
    const double range = recorded[e].pressure.maxCoeff() - recorded[e].pressure.minCoeff();
    sum += 0.5 * range / (std::numbers::sqrt2 * rms);
  }
  return sum / static_cast<double>(recorded.size());
}

// Both lists with half the share each; a block that both have is listed once.
std::vector<Place> MergedPlaces(std::vector<Place> places, std::vector<Place> others) {
  if (others.empty()) return places;
  for (Place& place : places) place.share *= 0.5;
  for (Place& other : others) {
    other.share *= 0.5;
    const auto same = std::find_if(places.begin(), places.end(),
                                   [&](const Place& place) { return place.block == other.block; });
    if (same == places.end()) {
      places.push_back(std::move(other));
      continue;
    }
    same->share += other.share;
    same->low_hz = std::min(same->low_hz, other.low_hz);
    same->high_hz = std::max(same->high_hz, other.high_hz);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.share > b.share; });
  return places;
}

}  // namespace

void Search::RepairPressure() {
  const auto unit = std::find_if(units_.begin(), units_.end(), [](const EffectForms& forms) {
    return forms[0]->kind() == EffectKind::kClipping &&
           forms[0]->block() == LoopBlock::kPressureInstrument;
  });
  if (unit == units_.end() || (reference_ && reference_->pressure_sharp_edge) ||
      !HasSharpEdge(records_, Channel::kPressure)) {
    return;
  }
  PressureRepair repair{
      Named(at_, *(*unit)[0]).candidate, std::move(records_), std::move(base_), {},
      std::move(at_.base_held_out),      *at_.experiments};
  const Declipped whole =
      DeclipAnew(repair.recorded, repair.recorded, repair.recorded_base, options_.threads);
  SetPressures(whole.pressure, &repair.experiments);
  repair.recorded_slack = ComputeSlack(repair.recorded, repair.recorded_base);
  records_ = RemakeCutRecords(repair.experiments, repair.recorded, lines_);
  base_ = FitBase(records_);
  at_.base_held_out = HoldOutEach(records_, base_);
  repair.clipping.gain = repair.recorded_base.cost() - base_.cost();
  repair.clipping.p_value = 0.0;
  repair.clipping.parameters = {
      WithoutError("fraction", MeanFraction(repair.recorded, records_), "")};
  units_.erase(unit);
  repair_ = std::move(repair);
  at_.experiments = &repair_->experiments;
  at_.recorded = &repair_->recorded;
  at_.refit = [this](const EffectFit& fit) { return Redeclip(fit).fit; };
}

// The likelihood is that of what was recorded: samples that a fit declipped leave no residual under
// that fit. Fits to records that each declipped itself can therefore be compared.
Search::RedeclippedFit Search::Redeclip(const EffectFit& under_base) const {
  std::vector<DiagnosisExperiment> experiments = repair_->experiments;
  Declipped whole = DeclipAnew(repair_->recorded, records_, under_base, options_.threads);
  auto records = std::make_shared<std::vector<CutRecord>>();
  EffectFit fit = under_base;
  for (int i = 0; i < kMostDeclippings; ++i) {
    SetPressures(whole.pressure, &experiments);
    *records = RemakeCutRecords(experiments, repair_->recorded, lines_);
    const double before = fit.cost();
    fit = ConvergedFit(*records, base_, whole.fit);
    if (std::abs(before - fit.cost()) < kConvergedGain) break;
    whole = DeclipAt(repair_->recorded, *records, fit, options_.threads);
  }
  return {std::move(fit), std::move(records)};
}

// The best form on records that the base declipped need not be the best on records of its own.
Attempt Search::Redeclipped(const Attempt& attempt, const EffectForms& forms) const {
  std::vector<RedeclippedFit> each(forms.size());
  RunUnits(forms.size(), options_.threads, [&](std::size_t i) {
    const bool fitted = forms[i] == attempt.fit->effect;
    each[i] = Redeclip(fitted ? *attempt.fit : FitEffect(records_, forms[i], base_));
  });
  RedeclippedFit& redeclipped = *std::min_element(
      each.begin(), each.end(),
      [](const RedeclippedFit& a, const RedeclippedFit& b) { return a.fit.cost() < b.fit.cost(); });
  AttemptContext at = at_;
  at.records = redeclipped.records.get();
  Attempt out = FromFit(at, std::move(redeclipped.fit));
  PayForParameters(&out);
  out.candidate.p_value = attempt.candidate.p_value;
  out.redeclipped = std::move(redeclipped.records);
  return out;
}

void Search::RedeclipBest() {
  if (!repair_ || Stopped()) return;
  double best = 0.0;
  for (const Attempt& attempt : attempts_) best = std::max(best, attempt.candidate.gain);
  const double least = std::max(DetectionGain(false), kWorthRedeclipping * best);
  RunUnits(attempts_.size(), options_.threads, [&](std::size_t i) {
    Attempt& attempt = attempts_[i];
    if (attempt.fit && attempt.fit->effect->ChangesAcousticCut() &&
        attempt.candidate.gain > least) {
      attempt = Redeclipped(attempt, units_[i]);
    }
  });
}

void Search::AddClipping(Diagnosis* diagnosis) {
  const std::string& id = repair_->clipping.effect;
  const bool nothing_else = diagnosis->kind == VerdictKind::kNone;
  Attempt alone;
  alone.candidate = repair_->clipping;
  alone.held_out = at_.base_held_out;
  alone.candidate.probability = 1.0;
  diagnosis->where =
      MergedPlaces(FindPlaces(records_, {alone}, VerdictKind::kEffect, repair_->recorded_slack, {}),
                   std::move(diagnosis->where));

  alone.candidate.probability = diagnosis->probability_none;
  for (Attempt& attempt : attempts_) {
    attempt.candidate = JoinCandidates(repair_->clipping, std::move(attempt.candidate));
  }
  const auto first = attempts_.begin() + (nothing_else || attempts_.empty() ? 0 : 1);
  attempts_.insert(std::find_if(first, attempts_.end(),
                                [&](const Attempt& other) {
                                  return other.candidate.probability < alone.candidate.probability;
                                }),
                   alone);
  gap_before_ = ComputeGapParts(records_, repair_->recorded_held_out, flame_noise_, lines_.empty());
  for (Attempt& attempt : attempts_) MeasureGap(&attempt);
  diagnosis->candidates = Candidates();

  diagnosis->repaired = id;
  diagnosis->probability_none = 0.0;
  diagnosis->gap_before = Gap(gap_before_);
  if (nothing_else) {
    diagnosis->kind = VerdictKind::kEffect;
    diagnosis->effect = id;
  } else if (diagnosis->kind == VerdictKind::kEffect) {
    diagnosis->effect = CombinedId(id, diagnosis->effect);
  }
  for (std::string& other : diagnosis->indistinguishable) other = CombinedId(id, other);
  if (!diagnosis->together.empty()) diagnosis->together = CombinedId(id, diagnosis->together);
  diagnosis->placebo_shrinkage = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace howl
