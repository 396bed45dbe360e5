#include "diagnosis/loop_budget/loop_budget.h"

#include <algorithm>
#include <utility>

#include "diagnosis/loop_budget/account/found_budget.h"
#include "diagnosis/loop_budget/account/item_bounds.h"
#include "diagnosis/loop_budget/loop_verdict.h"
#include "diagnosis/loop_budget/sample_facts.h"
#include "estimation/health/mended_records.h"
#include "estimation/joint_records/shared_units.h"

namespace howl {
namespace {

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
            PointsBetter(found.best, found.without[i])};
  }
  return {with.Density() - found.best.Density(), size, PointsBetter(with, found.best)};
}

// Hum has lines below the fits' band and in it.
std::vector<SampleFact> NamedOnce(std::vector<SampleFact> facts,
                                  const std::vector<BudgetEntry>& entries) {
  std::erase_if(facts, [&](const SampleFact& fact) {
    return std::ranges::find(entries, fact.effect, &BudgetEntry::item) != entries.end();
  });
  return facts;
}

}  // namespace

LoopDiagnosis DiagnoseLoops(const std::vector<LoopRecord>& all, const LoopForm& base,
                            const LoopBudgetOptions& options) {
  const std::vector<SampleFact> seen = SampleFactsOf(all, options.withheld);
  LoopBudgetOptions how = options;
  if (!RestCanBeFound(seen)) {
    how.withheld = LoopItemIds();
    how.one_delay = false;
  }
  const LoopFound found = SearchLoopBudget(
      LoopRecords(MendedRecords(all, options.withheld, options.seed, options.threads),
                  options.threads),
      base, how);
  const LoopRecords& records = found.records;
  LoopDiagnosis out;
  out.base = found.base.model;
  out.best = found.best.model;
  out.acoustics =
      LinesOf(records, found, found.with_acoustic_lines, &PointStructure::acoustic_lines);
  out.flame = LinesOf(records, found, found.with_flame_lines, &PointStructure::flame_lines);
  out.diagnosis.budget = BudgetOf(records, found, how);
  out.flame.of_gain = LinesOfGainIn(records, found.with_flame_lines);
  Budget& budget = *out.diagnosis.budget;
  budget.seen_in_samples = NamedOnce(seen, budget.entries);
  budget.acoustic_error = out.acoustics.size;
  budget.flame_error = out.flame.size;
  out.items = options.given;
  for (const LoopStep& step : found.steps) out.items.push_back(step.item.id);
  TakeVerdict(found, &out);
  if (out.diagnosis.kind != VerdictKind::kUnknown) {
    // Whether the gain follows the amplitude or the amplitude the gain, the loop does not know
    // then.
    if (out.flame.AreOfGain()) how.withheld.emplace_back("amplitude_dependent_gain");
    budget.not_found = BoundsBeside(records, found.best, found.base.model, how);
  }
  return out;
}

}  // namespace howl
