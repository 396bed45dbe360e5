#include "diagnosis/search/search.h"

#include <glog/logging.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <string>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/search/bootstrap.h"
#include "estimation/parallel.h"
#include "model/effects/catalogue.h"

namespace howl {
namespace {

// One unit of work for each identifier, whatever its forms.
std::vector<EffectForms> Units(const DiagnosisOptions& options) {
  std::vector<EffectForms> units;
  std::vector<EffectPointer> all = Catalogue(options.model.modes, options.model.harmonic_ratio);
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

// A reference contains the differences of its operating points' delays, so that what differs from
// it is due to the rig.
BaseModel ModelOf(const DiagnosisOptions& options) {
  BaseModel model = options.model;
  if (!options.reference.empty()) model.own_delays = false;
  return model;
}

// The number of starts of the search over all forms.
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

}  // namespace

Search::Search(const std::vector<DiagnosisExperiment>& experiments, const DiagnosisOptions& options)
    : options_(options),
      units_(Units(options)),
      records_(MakeCutRecords(experiments, ModelOf(options))) {
  lines_ = FindCoherentLines(records_);
  MaskLines(lines_, &records_);
  if (!options.reference.empty()) {
    reference_ = AbsorbReference(options.reference, experiments, &records_);
    lines_ = NewLines(lines_, reference_->lines);
  }
  base_ = FitBase(records_);
  if (!reference_) TakeLinesLeftOver();
  at_ = {&records_, &base_, &experiments, {}, options.memory, reference_ ? &*reference_ : nullptr};
  at_.base_held_out = HoldOutEach(records_, base_);
  slack_before_ = ComputeSlack(records_, base_);
}

void Search::TakeLinesLeftOver() {
  const std::vector<CoherentLine> left = FindLinesLeftOver(records_, base_);
  if (left.empty()) return;
  MaskLines(left, &records_);
  lines_.insert(lines_.end(), left.begin(), left.end());
  std::sort(lines_.begin(), lines_.end(), [](const CoherentLine& a, const CoherentLine& b) {
    return a.frequency_hz < b.frequency_hz;
  });
  base_ = FitBase(records_);
}

void Search::TryAll() {
  VLOG(1) << "base: cost " << base_.cost() << ", tau " << base_.tau_s << " s";
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
    VLOG(1) << attempts_[i].candidate.effect << ": gains " << attempts_[i].candidate.gain
            << " nats over the base, " << attempts_[i].parameters << " parameters";
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

std::optional<double> Search::LargestGain() {
  TryAll();
  if (Stopped()) return std::nullopt;
  double largest = -std::numeric_limits<double>::infinity();
  for (const Attempt& attempt : attempts_) largest = std::max(largest, attempt.candidate.gain);
  return largest;
}

void Search::Bootstrap() {
  bootstrap_gains_ = BootstrapGains(records_, base_, *at_.experiments, options_);
  if (bootstrap_gains_.empty()) return;
  for (Attempt& attempt : attempts_) {
    attempt.candidate.p_value = BootstrapPValue(bootstrap_gains_, attempt.candidate.gain);
  }
}

double Search::GainOfNoiseForTheBest() const {
  if (!bootstrap_gains_.empty()) return BootstrapDetectionGain(bootstrap_gains_);
  if (attempts_.empty()) return 0.0;
  const Attempt& best = attempts_[0];
  if (reference_) return ShowsInFlameAlone(best) && !best.leaks ? NoiseGivenReference(at_) : 0.0;
  const double gain = best.candidate.gain;
  if (best.model_free || !ShowsInFlame(best) || gain < DetectionGain(false) || gain > kNearNoise) {
    return 0.0;
  }
  const auto unit = std::find_if(units_.begin(), units_.end(), [&](const EffectForms& forms) {
    return forms[0]->id() == best.fit->effect->id();
  });
  return GainOfNoise(records_, base_, *at_.experiments, *unit, options_);
}

Attempt Search::Try(const EffectForms& forms) const {
  const Effect& effect = *forms[0];
  switch (effect.kind()) {
    case EffectKind::kTransfer:
      return TryTransfer(at_, "effect." + std::string(effect.id()), forms);
    case EffectKind::kColouredGain:
    case EffectKind::kSwitchingGain:
      return TryGain(at_, effect, fluctuation_);
    case EffectKind::kHum:
    case EffectKind::kTone:
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

}  // namespace howl
