#include "diagnosis/plan/planner.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/plan/plan_samples.h"
#include "diagnosis/samples/coherent_lines.h"
#include "estimation/parallel.h"
#include "model/effects/catalogue.h"
#include "model/numerics/constants.h"

namespace howl {
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

}  // namespace howl
