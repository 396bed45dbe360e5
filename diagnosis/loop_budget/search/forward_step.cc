#include "diagnosis/loop_budget/search/forward_step.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/trials/shared_effect_trial.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr std::size_t kMostFitted = 2;  // of a step's trials: those that gain most

struct Fitted {
  std::size_t trial = 0;
  LoopFit fit;
};

// Beside `best`, one of those that were fitted.
std::vector<LoopRival> RivalsOf(const std::vector<LoopTrial>& trials,
                                const std::vector<Fitted>& fitted, const Fitted& best,
                                const LoopFit& from) {
  std::vector<LoopRival> out;
  const double most = trials[best.trial].gain;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (i == best.trial) continue;
    const auto fit = std::ranges::find(fitted, i, &Fitted::trial);
    if (fit != fitted.end() && fit->fit.Density() > from.Density()) {
      out.push_back({trials[i].item, best.fit.Density() - fit->fit.Density()});
    } else if (std::abs(most - trials[i].gain) < WithinReach(most)) {
      out.push_back({trials[i].item, most - trials[i].gain});
    }
  }
  return out;
}

bool IsAmong(const std::vector<std::string>& keys, const LoopItem& item) {
  return std::ranges::find(keys, KeyOf(item)) != keys.end();
}

// What an item must have gained when it was last tried, so that it may be among those that this
// step fits, or in a class with one of them.
double Bar(const std::vector<LoopTrial>& trials, const std::vector<std::string>& fitted) {
  std::vector<double> gains;
  for (const LoopTrial& trial : trials) {
    if (!IsAmong(fitted, trial.item)) gains.push_back(trial.gain);
  }
  if (gains.size() < kMostFitted) return -std::numeric_limits<double>::infinity();
  std::ranges::nth_element(gains, gains.begin() + kMostFitted - 1, std::ranges::greater());
  return gains[kMostFitted - 1] - WithinReach(gains[kMostFitted - 1]);
}

}  // namespace

double ForwardSearch::LastGain(const LoopItem& item) const {
  const auto found = last_gain_.find(KeyOf(item));
  return found == last_gain_.end() ? std::numeric_limits<double>::infinity() : found->second;
}

std::vector<LoopTrial> ForwardSearch::Try(const LoopFit& from, double standing,
                                          const std::vector<LoopItem>& items,
                                          const std::string& key) {
  std::vector<LoopTrial> out = TryAll(records_, from, standing, items, key, options_);
  for (const LoopTrial& trial : out) {
    VLOG(1) << key << trial.item.id << " " << trial.gain << " nats";
    last_gain_[KeyOf(trial.item)] = trial.gain;
    if (!first_step_) continue;
    const auto [at, is_new] = alone_.emplace(trial.item.id, trial.gain);
    if (!is_new) at->second = std::max(at->second, trial.gain);
  }
  return out;
}

std::optional<LoopStep> ForwardSearch::BestOf(const std::vector<LoopTrial>& trials,
                                              const LoopFit& from, std::size_t offered,
                                              const std::string& key,
                                              std::vector<std::string>* fitted) const {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].gain > 0.0 && !IsAmong(*fitted, trials[i].item)) order.push_back(i);
  }
  std::ranges::sort(order, std::ranges::greater(),
                    [&](std::size_t i) { return std::pair(trials[i].gain, trials.size() - i); });
  std::vector<Fitted> best(std::min(order.size(), kMostFitted));
  RunUnits(best.size(), options_.threads, [&](std::size_t n) {
    const LoopTrial& trial = trials[order[n]];
    best[n] = {order[n], FitLoopFrom(records_, trial.model, trial.starts, MaximumTaken::kNext,
                                     key + "next/" + KeyOf(trial.item) + "/", options_)};
  });
  for (const Fitted& each : best) {
    VLOG(1) << key << trials[each.trial].item.id << " foretells "
            << each.fit.Density() - from.Density() << " nats better";
  }
  for (const LoopTrial& trial : trials) fitted->push_back(KeyOf(trial.item));
  std::ranges::stable_sort(best, std::ranges::greater(),
                           [](const Fitted& each) { return each.fit.Density(); });
  const double least = std::log(kOddsOfItem * static_cast<double>(offered));
  for (const Fitted& each : best) {
    if (!(each.fit.Density() > from.Density())) break;
    const LoopTrial& trial = trials[each.trial];
    LoopFit fit = FitTrial(records_, trial, Again(records_, each.fit, options_.threads),
                           key + "best/" + KeyOf(trial.item) + "/", options_);
    const double beside = LeftByForms(from.Density() - base_density_);
    if (fit.Density() > from.Density() + least + beside + trial.price) {
      LoopStep step{trial.item, least, trial.price, RivalsOf(trials, best, each, from)};
      step.after = std::move(fit);
      return step;
    }
  }
  return std::nullopt;
}

std::optional<LoopStep> ForwardSearch::Next(const LoopFit& from, const std::vector<LoopStep>& steps,
                                            const std::string& prefix) {
  std::vector<LoopItem> items = LoopItems(from.model, base_, options_.declared);
  std::erase_if(items, [&](const LoopItem& item) {
    return std::ranges::find(options_.withheld, item.id) != options_.withheld.end();
  });
  const std::string key = prefix + "step/" + std::to_string(steps.size()) + "/";
  const double standing = StandingEvidence(records_, from, key, options_);
  std::vector<LoopTrial> trials;
  std::vector<std::string> fitted;
  std::size_t offered = 0;
  // Errors at the cycle's lines come only where nothing else pays.
  for (const bool lines : {false, true}) {
    std::vector<LoopItem> waiting;
    std::ranges::copy_if(items, std::back_inserter(waiting),
                         [&](const LoopItem& item) { return (item.lines != nullptr) == lines; });
    offered += waiting.size();
    std::ranges::stable_sort(waiting, std::ranges::greater(),
                             [&](const LoopItem& item) { return LastGain(item); });
    double bar = std::numeric_limits<double>::infinity();
    while (!waiting.empty()) {
      const auto least = static_cast<std::ptrdiff_t>(std::min(waiting.size(), kMostFitted));
      const auto now = std::max(least, std::ranges::count_if(waiting, [&](const LoopItem& item) {
                                  return !(LastGain(item) < bar);
                                }));
      for (LoopTrial& trial : Try(from, standing, {waiting.begin(), waiting.begin() + now}, key)) {
        trials.push_back(std::move(trial));
      }
      waiting.erase(waiting.begin(), waiting.begin() + now);
      bar = Bar(trials, fitted);
      if (!waiting.empty() && !(LastGain(waiting[0]) < bar)) continue;
      if (std::optional<LoopStep> found = BestOf(trials, from, offered, key, &fitted)) {
        first_step_ = false;
        found->others = steps.size();
        return found;
      }
      bar = std::numeric_limits<double>::infinity();
    }
  }
  return std::nullopt;
}

}  // namespace howl
