#include "diagnosis/budget/budget.h"

#include <optional>

#include "diagnosis/budget/budget_search.h"
#include "diagnosis/budget/items/item_parameters.h"
#include "diagnosis/held_out/common_ceiling.h"
#include "diagnosis/held_out/places_left.h"

namespace howl {
namespace {

double NatsOf(const HeldOutScore& score, std::size_t point) {
  return score.nats[point][0] + score.nats[point][1];
}

// What the item is worth to the others: the rest of the entry.
void TakeLoss(const HeldOutScore& with, const BudgetLoss& loss, BudgetEntry* entry) {
  entry->lost_nats = loss.nats;
  for (std::size_t half = 0; half < 2; ++half) {
    entry->lost_on_halves[half] = with.Nats(half) - loss.score.Nats(half);
  }
  for (std::size_t e = 0; e < with.nats.size(); ++e) {
    if (NatsOf(with, e) > NatsOf(loss.score, e)) ++entry->experiments_better;
  }
}

}  // namespace

Budget FindBudget(const std::vector<DiagnosisExperiment>& experiments, const BaseModel& model,
                  const BudgetOptions& options) {
  Budget out;
  BudgetRecords records = MakeBudgetRecords(experiments, model);
  const std::optional<BudgetFound> found = SearchBudget(&records, options);
  if (!found) {
    out.stopped = true;
    return out;
  }
  CommonCeiling ceiling;
  ceiling.Lower(found->base);
  for (const BudgetStep& step : found->steps) ceiling.Lower(step.after);
  for (const BudgetLoss& loss : found->losses) ceiling.Lower(loss.score);
  out.experiments = experiments.size();
  out.gap_before = ceiling.Gap(found->base);
  out.gap_left = ceiling.Gap(found->all);
  out.acoustic_error = found->fit.shared.eps_a;
  out.flame_error = found->fit.shared.eps_b;
  std::vector<BudgetItem> items;
  for (const BudgetStep& step : found->steps) items.push_back(step.item);
  double before = out.gap_before;
  for (std::size_t i = 0; i < found->steps.size(); ++i) {
    const BudgetLoss& loss = found->losses[i];
    BudgetEntry entry;
    entry.item = items[i].id;
    entry.gap_before = before;
    entry.gap_after = ceiling.Gap(found->steps[i].after);
    before = entry.gap_after;
    TakeLoss(found->all, loss, &entry);
    entry.lost_gap = ceiling.Gap(loss.score) - out.gap_left;
    entry.equals = found->steps[i].equals;
    entry.parameters = ItemParameters(records.whole, found->fit, items, i);
    out.entries.push_back(std::move(entry));
  }
  if (out.gap_left > 0.0) {
    std::vector<std::string> names;
    for (const CutRecord& record : records.records) names.push_back(record.name);
    out.left = PlacesLeft(names, ceiling.Against(found->all));
  }
  return out;
}

}  // namespace howl
