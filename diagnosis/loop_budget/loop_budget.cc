#include "diagnosis/loop_budget/loop_budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/held_out/common_ceiling.h"
#include "diagnosis/held_out/octave_gaps.h"
#include "diagnosis/held_out/places_left.h"
#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/loop_held_out.h"
#include "diagnosis/loop_budget/loop_item_parameters.h"
#include "diagnosis/loop_budget/sample_facts.h"
#include "diagnosis/loop_budget/search/loop_search.h"
#include "estimation/joint_records/loop_names.h"
#include "estimation/joint_records/shared_units.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

std::size_t Better(const LoopFit& with, const LoopFit& without) {
  std::size_t out = 0;
  for (std::size_t e = 0; e < with.log_density.size(); ++e) {
    if (with.log_density[e] > without.log_density[e]) ++out;
  }
  return out;
}

// Of the errors of one cut: what they gain where they are added last, or lose where they go.
LinesLeft LinesOf(const LoopRecords& records, const LoopFound& found, const LoopFit& with,
                  int PointStructure::*lines) {
  const SharedUnits units(with.model.structure, records.Whole(with.model, 0), with.fit.reference);
  const ErrorGroup& group =
      lines == &PointStructure::acoustic_lines ? units.errors().front() : units.errors().back();
  const double size = with.fit.law.spread[group.first];
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    if (found.steps[i].item.lines != lines) continue;
    return {found.best.Density() - found.without[i].Density(), size,
            Better(found.best, found.without[i])};
  }
  return {with.Density() - found.best.Density(), size, Better(with, found.best)};
}

// Without errors at the cycle's lines, the best loop has at most this density.
double DensityWithoutLines(const LoopFound& found) {
  double out = found.best.Density();
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    if (found.steps[i].item.lines != nullptr) out = std::min(out, found.without[i].Density());
  }
  return out;
}

Budget BudgetOf(const LoopRecords& records, const LoopFound& found,
                const LoopBudgetOptions& options) {
  const HeldOutScore base = ScoreHeldOut(records, found.base, "base/", options);
  // With nothing added the best loop is the base, driven as it was.
  const HeldOutScore best =
      found.steps.empty() ? base : ScoreHeldOut(records, found.best, "best/", options);
  std::vector<HeldOutScore> after(found.steps.size());
  std::vector<HeldOutScore> without(found.steps.size());
  RunUnits(found.steps.size(), options.threads, [&](std::size_t i) {
    const std::string number = std::to_string(i) + "/";
    after[i] = ScoreHeldOut(records, found.steps[i].after, "after/" + number, options);
    without[i] = ScoreHeldOut(records, found.without[i], "lost/" + number, options);
  });
  CommonCeiling ceiling;
  ceiling.Lower(base);
  ceiling.Lower(best);
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    ceiling.Lower(after[i]);
    ceiling.Lower(without[i]);
  }
  Budget out;
  out.best_model = ModelLine(found.best.model.structure, found.best.model.flame_input);
  out.experiments = records.size();
  out.gap_before = ceiling.Gap(base);
  out.gap_left = ceiling.Gap(best);
  double before = out.gap_before;
  auto mode = static_cast<std::size_t>(found.base.model.structure.modes);
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    const LoopStep& step = found.steps[i];
    BudgetEntry entry;
    entry.item = step.item.id;
    if (step.item.effect) {
      const EffectForm form = step.item.effect->form();
      if (!form.key.empty()) entry.form = form.key + " " + form.value;
    }
    entry.gap_before = before;
    entry.gap_after = ceiling.Gap(after[i]);
    before = entry.gap_after;
    entry.lost_nats = found.best.Density() - found.without[i].Density();
    entry.lost_gap = ceiling.Gap(without[i]) - out.gap_left;
    for (std::size_t half = 0; half < 2; ++half) {
      entry.lost_on_halves[half] = best.Nats(half) - without[i].Nats(half);
    }
    entry.experiments_better = Better(found.best, found.without[i]);
    entry.equals = step.equals;
    // Jumps at random times have the same spectrum.
    if (step.item.id == "parametric_noise") entry.equals.emplace_back("intermittency");
    entry.parameters = LoopItemParameters(records, found.best, step.item, mode, options);
    if (step.item.kind == LoopItemKind::kMode) ++mode;
    out.entries.push_back(std::move(entry));
  }
  const HeldOutScore left = ceiling.Against(best);
  if (out.gap_left > 0.0) out.left = PlacesLeft(records.names(), left);
  out.floor = left.Floor();
  out.left_by_octave = GapsByOctave(records.names(), records.cycle_hz(), left);
  return out;
}

std::string Joined(const Budget& budget) {
  std::string out;
  const auto add = [&out](const std::string& name) { out += (out.empty() ? "" : "+") + name; };
  for (const SampleFact& fact : budget.seen_in_samples) add(fact.effect);
  for (const BudgetEntry& entry : budget.entries) add(entry.item);
  return out;
}

// All that is named, as the only candidate.
void AddCandidate(const LoopFound& found, double probability, Diagnosis* diagnosis) {
  const Budget& budget = *diagnosis->budget;
  Candidate candidate;
  candidate.effect = Joined(budget);
  candidate.probability = probability;
  candidate.gain = found.best.Density() - found.base.Density();
  candidate.gap_after = budget.gap_left;
  candidate.shrinkage = budget.gap_before > 0.0 ? 1.0 - budget.gap_left / budget.gap_before : 0.0;
  candidate.shrinkage_low = candidate.shrinkage_high = std::numeric_limits<double>::quiet_NaN();
  candidate.p_value = std::numeric_limits<double>::quiet_NaN();
  diagnosis->candidates.push_back(std::move(candidate));
}

// What the samples show stands in them; of what else there may be nothing is said.
void TakeWhatSamplesShow(const LoopFound& found, Diagnosis* diagnosis) {
  diagnosis->kind = VerdictKind::kEffect;
  diagnosis->effect = Joined(*diagnosis->budget);
  AddCandidate(found, 1.0, diagnosis);
}

void TakeVerdict(const LoopFound& found, LoopDiagnosis* out) {
  Diagnosis& diagnosis = out->diagnosis;
  const double gained = std::max(out->acoustics.nats, out->flame.nats);
  const bool unknown = gained > std::log(kOddsOfUnknown);
  const bool any = std::ranges::any_of(
      found.steps, [](const LoopStep& step) { return step.item.lines == nullptr; });
  diagnosis.kind = unknown ? VerdictKind::kUnknown
                   : any   ? VerdictKind::kEffect
                           : VerdictKind::kNone;
  if (diagnosis.kind == VerdictKind::kEffect) diagnosis.effect = Joined(*diagnosis.budget);
  const double best = DensityWithoutLines(found);
  const bool lines_stay = best < found.best.Density();
  const double with_lines = lines_stay ? found.best.Density() : best + gained;
  const double base = found.base.Density();
  const double most = std::max({with_lines, best, base});
  const std::array<double, 3> odds = {std::exp(with_lines - most),
                                      any ? std::exp(best - most) : 0.0, std::exp(base - most)};
  const double sum = odds[0] + odds[1] + odds[2];
  diagnosis.probability_unknown = odds[0] / sum;
  diagnosis.probability_none = odds[2] / sum;
  if (any) AddCandidate(found, odds[1] / sum, &diagnosis);
}

std::string AdviceOf(const LoopDiagnosis& found) {
  if (!found.diagnosis.budget->seen_in_samples.empty()) {
    return "record again, within the converter's range and with finer steps: whatever is fitted to "
           "such samples speaks of what was done to them";
  }
  const std::string& model = found.diagnosis.budget->best_model;
  switch (found.diagnosis.kind) {
    case VerdictKind::kNone:
      return "the config's loop stands";
    case VerdictKind::kEffect:
      return "howl fit with " + model;
    case VerdictKind::kUnknown:
      break;
  }
  return "howl fit with " + model +
         ", which is the best loop found, but not the rig's: distrust what it says of the cycle";
}

}  // namespace

LoopDiagnosis DiagnoseLoops(const std::vector<LoopRecord>& all, const LoopForm& base,
                            const LoopBudgetOptions& options) {
  const std::vector<SampleFact> seen = SampleFactsOf(all, options.withheld);
  LoopBudgetOptions how = options;
  if (!seen.empty()) how.withheld = LoopItemIds();
  const LoopFound found = SearchLoopBudget(LoopRecords(all, options.threads), base, how);
  const LoopRecords& records = found.records;
  LoopDiagnosis out;
  out.base = found.base.model;
  out.best = found.best.model;
  out.acoustics =
      LinesOf(records, found, found.with_acoustic_lines, &PointStructure::acoustic_lines);
  out.flame = LinesOf(records, found, found.with_flame_lines, &PointStructure::flame_lines);
  Diagnosis& diagnosis = out.diagnosis;
  diagnosis.budget = BudgetOf(records, found, options);
  diagnosis.budget->seen_in_samples = seen;
  out.items = options.given;
  for (const BudgetEntry& entry : diagnosis.budget->entries) out.items.push_back(entry.item);
  diagnosis.where = diagnosis.budget->left;
  diagnosis.gap_before = diagnosis.budget->gap_before;
  diagnosis.gap_after = diagnosis.budget->gap_left;
  diagnosis.gap_floor = diagnosis.budget->floor;
  diagnosis.budget->acoustic_error = out.acoustics.size;
  diagnosis.budget->flame_error = out.flame.size;
  if (seen.empty()) {
    TakeVerdict(found, &out);
  } else {
    TakeWhatSamplesShow(found, &diagnosis);
  }
  diagnosis.advice = AdviceOf(out);
  return out;
}

}  // namespace howl
