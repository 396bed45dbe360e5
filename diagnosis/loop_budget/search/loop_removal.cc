#include "diagnosis/loop_budget/search/loop_removal.h"

#include <glog/logging.h>

#include <algorithm>

#include "diagnosis/loop_budget/forms/odds.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

// The modes that were added stand behind the base's in the order of their steps.
std::size_t ModeOf(const std::vector<LoopStep>& steps, std::size_t which, const LoopForm& base) {
  auto mode = static_cast<std::size_t>(base.structure.modes);
  for (std::size_t i = 0; i < which; ++i) {
    if (steps[which].item.kind == LoopItemKind::kMode && steps[i].item.kind == LoopItemKind::kMode)
      ++mode;
  }
  return mode;
}

LoopFit FitWithout(const LoopRecords& records, const LoopForm& base, const LoopStanding& standing,
                   std::size_t which, MaximumTaken taken, const std::string& key,
                   const LoopBudgetOptions& options) {
  const LoopForm model = Without(standing.best.model, standing.steps[which].item, base);
  const LoopStarts starts =
      StartsWithout(records, standing.best, model, ModeOf(standing.steps, which, base));
  return FitLoopFrom(records, model, starts.rows, taken,
                     key + "without/" + std::to_string(which) + "/", options);
}

}  // namespace

void TakeAway(const LoopRecords& records, const LoopForm& base,
              const std::vector<std::size_t>& which, MaximumTaken taken, const std::string& key,
              const LoopBudgetOptions& options, LoopStanding* out) {
  RunUnits(which.size(), options.threads, [&](std::size_t n) {
    const std::size_t i = which[n];
    LoopFit& without = out->without[i];
    without = without.log_density.empty()
                  ? FitWithout(records, base, *out, i, taken, key, options)
                  : FitLoopFrom(records, without.model, {ParametersOf(without)}, taken,
                                key + "without/" + std::to_string(i) + "/", options);
  });
  for (const std::size_t i : which) {
    VLOG(1) << key << out->steps[i].item.id << " "
            << out->best.Density() - out->without[i].Density() << " nats lost";
  }
}

std::vector<std::size_t> Others(const LoopStanding& found, const std::vector<std::size_t>& than) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    if (std::ranges::find(than, i) == than.end()) out.push_back(i);
  }
  return out;
}

std::vector<std::size_t> Idle(const LoopStanding& found, double base_density) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    const LoopFit& without = found.without[i];
    if (without.log_density.empty()) continue;
    const double least =
        found.steps[i].least + found.steps[i].price + LeftByForms(without.Density() - base_density);
    if (without.Density() < found.best.Density() - least) continue;
    out.push_back(i);
  }
  std::ranges::stable_sort(out, std::ranges::greater(),
                           [&](std::size_t i) { return found.without[i].Density(); });
  return out;
}

}  // namespace howl
