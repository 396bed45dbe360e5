#include "diagnosis/loop_budget/search/given_items.h"

#include <glog/logging.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/loop_budget/trials/shared_effect_trial.h"

namespace howl {

GivenLoop WithGiven(const LoopRecords& records, const LoopForm& base, LoopFit fit,
                    const LoopBudgetOptions& options) {
  std::vector<LoopItem> given;
  for (std::size_t i = 0; i < options.given.size(); ++i) {
    const std::string key = "given/" + std::to_string(i) + "/";
    std::vector<LoopItem> items = LoopItems(fit.model, base, options.declared);
    std::erase_if(items, [&](const LoopItem& item) { return item.id != options.given[i]; });
    if (items.empty()) continue;
    const double standing = StandingEvidence(records, fit, key, options);
    const std::vector<LoopTrial> trials = TryAll(records, fit, standing, items, key, options);
    const LoopTrial& best = *std::ranges::max_element(trials, {}, &LoopTrial::gain);
    const double before = fit.Density();
    fit = FitTrial(records, best, best.starts, key, options);
    given.push_back(best.item);
    VLOG(1) << key << best.item.id << " " << best.gain << " nats, foretells "
            << fit.Density() - before << " better";
  }
  return {std::move(fit), std::move(given)};
}

}  // namespace howl
