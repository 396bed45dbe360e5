// Classes of effects that are not told apart, and the measurements that would separate them.
#include <algorithm>
#include <numeric>
#include <utility>

#include "diagnosis/plan/plan_samples.h"
#include "diagnosis/plan/planner.h"

namespace howl {
namespace {

constexpr std::size_t kMostPairs = 3;  // for which further measurements are tried

}  // namespace

void FindClasses(Plan* plan) {
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

// The pairs that are not told apart, also where that holds for one of the two alone: those that are
// least told apart are those for which a measurement is worth most.
void Planner::FindPairs(Plan* plan) const {
  for (const PlannedEffect& effect : plan->effects) {
    for (const PlannedRival& rival : effect.rivals) {
      if (!median_.contains(effect.effect) || rival.nats > rival.nats_needed) continue;
      const bool known = std::ranges::any_of(plan->pairs, [&](const PlannedPair& pair) {
        return pair.effect == rival.effect && pair.other == effect.effect;
      });
      if (!known)
        plan->pairs.push_back({effect.effect, rival.effect, rival.nats, rival.nats_needed, {}});
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

}  // namespace howl
