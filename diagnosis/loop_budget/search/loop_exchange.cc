#include "diagnosis/loop_budget/search/loop_exchange.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/trials/shared_effect_trial.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

struct Exchange {
  std::size_t step = 0;
  LoopItem rival;
  std::optional<LoopFit> fit = {};  // none of a trial that says of itself that it is none
  double price = 0.0;               // the rival's
};

// Whether it has been found worse beside all that stands, by more than a further search of the same
// loop could make up: nothing has come after the item, or gone.
bool IsFarBehind(const LoopRival& rival, const LoopStanding& now, std::size_t step) {
  const LoopStep& of = now.steps[step];
  const bool as_it_came = step == of.others && now.steps.size() == of.others + 1;
  return as_it_came && rival.behind > WithinReach(now.best.Density() - now.without[step].Density());
}

// Of rivals that may come where the step's item is not.
std::vector<Exchange> Possible(const LoopForm& base, const LoopStanding& now,
                               const LoopBudgetOptions& options) {
  std::vector<Exchange> out;
  for (std::size_t i = 0; i < now.steps.size(); ++i) {
    const std::vector<LoopItem> offered = LoopItems(now.without[i].model, base, options.declared);
    for (const LoopRival& rival : now.steps[i].rivals) {
      const bool possible = std::ranges::find(offered, KeyOf(rival.item), KeyOf) != offered.end();
      if (possible && !IsFarBehind(rival, now, i)) out.push_back({i, rival.item});
    }
  }
  return out;
}

}  // namespace

std::optional<LoopStanding> BestExchange(const LoopRecords& records, const LoopForm& base,
                                         const std::string& key, const LoopBudgetOptions& options,
                                         LoopStanding* now) {
  std::vector<Exchange> exchanges = Possible(base, *now, options);
  RunUnits(exchanges.size(), options.threads, [&](std::size_t n) {
    Exchange& each = exchanges[n];
    const std::string of_this = key + std::to_string(each.step) + "/" + KeyOf(each.rival) + "/";
    const LoopTrial trial =
        TryAll(records, now->without[each.step], 0.0, {each.rival}, of_this, options)[0];
    if (!std::isfinite(trial.gain)) return;
    each.fit = FitTrial(records, trial, trial.starts, of_this, options);
    each.price = trial.price;
  });
  for (LoopStep& step : now->steps) step.equals.clear();
  const Exchange* best = nullptr;
  double most = 0.0;
  for (const Exchange& each : exchanges) {
    if (!each.fit) continue;
    LoopStep& step = now->steps[each.step];
    const double gain = each.fit->Density() - now->best.Density() - (each.price - step.price);
    VLOG(1) << key << each.rival.id << " for " << step.item.id << " " << gain << " nats";
    // Forms of one item are no class.
    const bool named = each.rival.id == step.item.id ||
                       std::ranges::find(step.equals, each.rival.id) != step.equals.end();
    if (!named && gain > -std::log(kOddsOfClass)) step.equals.push_back(each.rival.id);
    if (gain > most) {
      most = gain;
      best = &each;
    }
  }
  if (best == nullptr) return std::nullopt;
  LoopStanding out{*best->fit, now->steps, {}};
  const LoopStep& before = now->steps[best->step];
  LoopStep next{best->rival, before.least, best->price, before.rivals, before.others, *best->fit};
  std::erase_if(next.rivals,
                [&](const LoopRival& each) { return KeyOf(each.item) == KeyOf(best->rival); });
  next.rivals.push_back({before.item});
  out.steps.erase(out.steps.begin() + static_cast<std::ptrdiff_t>(best->step));
  out.steps.push_back(std::move(next));
  return out;
}

}  // namespace howl
