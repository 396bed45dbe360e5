#include "diagnosis/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "diagnosis/plan/plan_samples.h"
#include "diagnosis/plan/plan_table.h"
#include "diagnosis/plan/plan_trials.h"
#include "diagnosis/samples/coherent_lines.h"
#include "diagnosis/search/choose_modes.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Of a longer record the beginning is looked at, and counts for the whole: what an effect changes
// grows with the record's length.
constexpr std::size_t kLongestRecord = 32768;
constexpr std::size_t kMostPairs = 3;  // for which further measurements are tried

std::vector<DiagnosisExperiment> Shortened(const std::vector<DiagnosisExperiment>& experiments,
                                           std::vector<double>* scales) {
  std::vector<DiagnosisExperiment> out = experiments;
  for (DiagnosisExperiment& each : out) {
    Record& record = each.record;
    const auto whole = static_cast<double>(record.pressure.size());
    record.pressure.resize(std::min(record.pressure.size(), kLongestRecord));
    record.heat_release.resize(record.pressure.size());
    scales->push_back(whole / static_cast<double>(record.pressure.size()));
  }
  return out;
}

// The planning of one rig.
class Planner {
 public:
  Planner(std::vector<DiagnosisExperiment> experiments, std::vector<double> scales,
          const PlanOptions& options);
  Plan Run();

 private:
  std::vector<WeighedPoint> PointsOf(const std::vector<CutRecord>& records, const EffectFit& fit,
                                     double scale) const;
  PlannedSize SizeOf(std::size_t line) const;
  // The effect's lines, the one of median smallest size first.
  std::vector<std::size_t> LinesOf(const std::string& id) const;
  PlannedEffect Planned(const std::vector<std::size_t>& lines) const;
  std::vector<PlannedRival> RivalsOf(std::size_t line) const;
  PlannedRival Against(std::size_t line, const std::string& rival) const;
  void FindClasses(Plan* plan) const;
  void FindPairs(Plan* plan) const;
  // The nats between entry i of `line` and the rival, with a trial measurement made.
  PlannedTrial Tried(const TrialMeasurement& trial, std::size_t line,
                     const std::string& rival) const;

  const PlanOptions& options_;
  std::vector<DiagnosisExperiment> experiments_;
  std::vector<double> scales_;
  std::vector<EffectPointer> catalogue_;
  std::vector<CutRecord> records_;
  EffectFit base_;
  PlanTable table_;
  std::optional<PlanGains> gains_;
  std::vector<std::string> transfer_;          // identifiers, in the catalogue's order
  std::map<std::string, std::size_t> median_;  // line of each
};

Planner::Planner(std::vector<DiagnosisExperiment> experiments, std::vector<double> scales,
                 const PlanOptions& options)
    : options_(options),
      experiments_(std::move(experiments)),
      scales_(std::move(scales)),
      records_(MakeCutRecords(experiments_, options.model)) {
  const std::vector<CoherentLine> lines = FindCoherentLines(records_);
  MaskLines(lines, &records_);
  base_ = FitBase(records_);
  catalogue_ = Catalogue(options.model.modes, options.model.harmonic_ratio);
  catalogue_.insert(catalogue_.end(), options.further.begin(), options.further.end());
  std::erase_if(catalogue_, [&](const EffectPointer& effect) {
    return std::ranges::find(options.withheld, effect->id()) != options.withheld.end();
  });
}

std::vector<WeighedPoint> Planner::PointsOf(const std::vector<CutRecord>& records,
                                            const EffectFit& fit, double scale) const {
  std::vector<WeighedPoint> points(records.size());
  RunUnits(records.size(), options_.threads, [&](std::size_t e) {
    const double own = e < scales_.size() ? scales_[e] : 1.0;
    points[e] = {std::make_unique<PlanPoint>(records[e], fit, e), scale * own};
  });
  return points;
}

PlannedSize Planner::SizeOf(std::size_t line) const {
  const EffectLine& at = table_.lines[line];
  PlannedSize out;
  const double size = table_.ladders[line].smallest;
  out.smallest = std::isfinite(size) ? at.ParameterAt(size) : kNaN;
  out.form = at.effect->form();
  for (std::size_t j = 0; j < at.values.size(); ++j) {
    if (j != at.size_parameter) {
      out.others.emplace_back(at.effect->parameters()[j].name, at.values[j]);
    }
  }
  return out;
}

std::vector<std::size_t> Planner::LinesOf(const std::string& id) const {
  std::vector<std::size_t> lines;
  for (std::size_t l = 0; l < table_.lines.size(); ++l) {
    if (table_.lines[l].effect->id() == id) lines.push_back(l);
  }
  std::vector<std::size_t> order = lines;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return table_.ladders[a].smallest < table_.ladders[b].smallest;
  });
  const std::size_t median = order[(order.size() - 1) / 2];
  std::stable_partition(lines.begin(), lines.end(), [&](std::size_t l) { return l == median; });
  return lines;
}

PlannedRival Planner::Against(std::size_t line, const std::string& rival) const {
  const EffectLine& at = table_.lines[line];
  const Ladder& ladder = table_.ladders[line];
  PlannedRival out;
  out.effect = rival;
  const auto margin = [&](const Rung& rung) {
    return NatsBetween(table_, *gains_, rung.entry, line, rival) /
           NatsToTellApart(rung.gain, *at.effect);
  };
  const Rung& reference = *ReferenceRung(ladder);
  out.nats = NatsBetween(table_, *gains_, reference.entry, line, rival);
  out.nats_needed = NatsToTellApart(reference.gain, *at.effect);
  // From the highest rung down, as far as the two stay apart.
  double above = kNaN;
  double size_above = kNaN;
  for (auto rung = ladder.rungs.rbegin(); rung != ladder.rungs.rend(); ++rung) {
    const double here = margin(*rung);
    if (!(here >= 1.0)) {
      if (std::isfinite(above) && here > 0.0) {
        const double share = std::log(1.0 / here) / std::log(above / here);
        size_above = rung->size * std::pow(size_above / rung->size, share);
      }
      break;
    }
    above = here;
    size_above = rung->size;
  }
  if (std::isfinite(size_above)) {
    out.told_apart_at = at.ParameterAt(std::max(size_above, ladder.smallest));
  }
  return out;
}

std::vector<PlannedRival> Planner::RivalsOf(std::size_t line) const {
  std::vector<PlannedRival> out;
  for (const std::string& id : transfer_) {
    if (id != table_.lines[line].effect->id()) out.push_back(Against(line, id));
  }
  return out;
}

PlannedEffect Planner::Planned(const std::vector<std::size_t>& lines) const {
  const std::size_t line = lines[0];
  const EffectLine& at = table_.lines[line];
  const EffectParameter& p = at.parameter();
  PlannedEffect out;
  out.effect = at.effect->id();
  out.block = at.effect->block();
  out.parameter = p.name;
  out.unit = p.unit;
  out.null_value = p.null_value;
  out.from_infinity = !std::isfinite(p.null_value);
  out.gain_needed = GainNeeded(*at.effect, at.ValuesAt(at.typical), records_[0].at);
  out.size = SizeOf(line);
  for (const std::size_t l : lines) out.sizes.push_back(SizeOf(l));
  if (const Rung* reference = ReferenceRung(table_.ladders[line])) {
    out.reference = at.ParameterAt(reference->size);
    out.reference_gain = reference->gain;
    out.rivals = RivalsOf(line);
  }
  return out;
}

void Planner::FindClasses(Plan* plan) const {
  const std::vector<PlannedEffect>& effects = plan->effects;
  const auto apart = [&](const PlannedEffect& a, const PlannedEffect& b) {
    const auto rival = std::ranges::find(a.rivals, b.effect, &PlannedRival::effect);
    return rival == a.rivals.end() || rival->nats > rival->nats_needed;
  };
  std::vector<std::size_t> root(effects.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  for (std::size_t i = 0; i < effects.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (apart(effects[i], effects[j]) || apart(effects[j], effects[i])) continue;
      std::ranges::replace(root, root[i], root[j]);
    }
  }
  for (std::size_t i = 0; i < effects.size(); ++i) {
    std::vector<std::string> members;
    for (std::size_t j = 0; j < effects.size() && root[i] == i; ++j) {
      if (root[j] == i) members.push_back(effects[j].effect);
    }
    if (members.size() > 1) plan->classes.push_back(std::move(members));
  }
}

PlannedTrial Planner::Tried(const TrialMeasurement& trial, std::size_t line,
                            const std::string& rival) const {
  const std::string own(table_.lines[line].effect->id());
  PlanTable part;
  part.lines = table_.lines;
  part.log_delays = table_.log_delays;
  part.ladders.resize(part.lines.size());
  const std::size_t wanted = ReferenceRung(table_.ladders[line])->entry;
  std::size_t entry = 0;
  for (std::size_t l = 0; l < part.lines.size(); ++l) {
    const std::string_view id = part.lines[l].effect->id();
    if (id != rival && l != line) continue;
    part.ladders[l].step = table_.ladders[l].step;
    for (Rung rung : table_.ladders[l].rungs) {
      if (l == line && rung.entry != wanted) continue;
      if (l == line) entry = part.entries.size();
      part.entries.push_back(table_.entries[rung.entry]);
      rung.entry = part.entries.size() - 1;
      part.ladders[l].rungs.push_back(rung);
    }
  }
  part.products =
      ProductsOfAll(PointsOf(records_, trial.fit ? *trial.fit : base_, trial.record_scale),
                    part.lines, part.entries, options_.threads);
  if (!trial.further.empty()) {
    const std::vector<PointProducts> more =
        ProductsOfAll(PointsOf(trial.further, *trial.further_fit, 1.0), part.lines, part.entries,
                      options_.threads);
    part.products.insert(part.products.end(), more.begin(), more.end());
    if (!part.log_delays.empty()) part.log_delays.push_back(0.0);
  }
  const PlanGains gains = part.Gains();
  const Effect& effect = *part.lines[line].effect;
  return {trial.what, NatsBetween(part, gains, entry, line, rival),
          NatsToTellApart(gains.Gain(entry, effect.parameters().size()), effect)};
}

// The pairs of one class that come nearest to being told apart are those for which a measurement is
// worth most.
void Planner::FindPairs(Plan* plan) const {
  for (const std::vector<std::string>& members : plan->classes) {
    for (const std::string& own : members) {
      const auto effect = std::ranges::find(plan->effects, own, &PlannedEffect::effect);
      for (const PlannedRival& rival : effect->rivals) {
        const bool later =
            std::ranges::find(members, own) < std::ranges::find(members, rival.effect);
        if (!later || std::ranges::find(members, rival.effect) == members.end()) continue;
        if (!median_.contains(own) || rival.nats > rival.nats_needed) continue;
        plan->pairs.push_back({own, rival.effect, rival.nats, rival.nats_needed, {}});
      }
    }
  }
  std::stable_sort(plan->pairs.begin(), plan->pairs.end(),
                   [](const PlannedPair& a, const PlannedPair& b) {
                     return a.nats / a.nats_needed < b.nats / b.nats_needed;
                   });
  if (plan->pairs.size() > kMostPairs) plan->pairs.resize(kMostPairs);
  if (plan->pairs.empty()) return;
  const std::vector<TrialMeasurement> trials =
      TrialMeasurements({&experiments_, &records_, &base_});
  for (PlannedPair& pair : plan->pairs) {
    for (const TrialMeasurement& trial : trials) {
      pair.trials.push_back(Tried(trial, median_.at(pair.effect), pair.other));
    }
    std::stable_sort(pair.trials.begin(), pair.trials.end(),
                     [](const PlannedTrial& a, const PlannedTrial& b) {
                       return a.nats / a.nats_needed > b.nats / b.nats_needed;
                     });
  }
}

Plan Planner::Run() {
  Plan plan;
  plan.model = options_.model;
  plan.tau_s = base_.tau_s;
  plan.delay_scatter = base_.delay_scatter;
  std::vector<EffectLine> lines;
  for (const EffectPointer& effect : catalogue_) {
    const std::vector<EffectLine> own = EffectLines(effect, records_[0]);
    lines.insert(lines.end(), own.begin(), own.end());
    const std::string id(effect->id());
    if (!own.empty() && std::ranges::find(transfer_, id) == transfer_.end()) {
      transfer_.push_back(id);
    }
  }
  std::vector<double> log_delays;
  for (const ExperimentFit& each : base_.experiments) {
    if (options_.model.own_delays && records_.size() > 1) log_delays.push_back(each.log_delay);
  }
  table_ = MakePlanTable(std::move(lines), PointsOf(records_, base_, 1.0), std::move(log_delays),
                         records_[0].at, options_.threads);
  gains_ = table_.Gains();
  const PlanRecords in_samples{&experiments_, &records_, &base_};
  std::vector<std::string> done;
  std::vector<EffectPointer> first_forms;
  for (const EffectPointer& effect : catalogue_) {
    const std::string id(effect->id());
    if (std::ranges::find(done, id) != done.end()) continue;
    done.push_back(id);
    first_forms.push_back(effect);
  }
  std::vector<std::optional<PlannedEffect>> planned(first_forms.size());
  RunUnits(first_forms.size(), options_.threads, [&](std::size_t i) {
    const std::string id(first_forms[i]->id());
    if (std::ranges::find(transfer_, id) != transfer_.end()) {
      planned[i] = Planned(LinesOf(id));
    } else {
      planned[i] = PlanInSamples(in_samples, *first_forms[i]);
    }
  });
  for (std::optional<PlannedEffect>& each : planned) {
    if (each) plan.effects.push_back(std::move(*each));
  }
  for (const std::string& id : transfer_) median_[id] = LinesOf(id)[0];
  FindClasses(&plan);
  FindPairs(&plan);
  return plan;
}

}  // namespace

Plan MakePlan(const std::vector<DiagnosisExperiment>& experiments, const PlanOptions& options) {
  std::vector<double> scales;
  std::vector<DiagnosisExperiment> parts = Shortened(experiments, &scales);
  PlanOptions chosen = options;
  if (options.choose_modes) chosen.model.modes = ChooseModes(parts, options.model).modes;
  return Planner(std::move(parts), std::move(scales), chosen).Run();
}

}  // namespace howl
