#include "trial/case_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

#include "estimation/unit_seed.h"

namespace howl {
namespace {

using EffectSet = std::vector<std::string>;

struct Group {
  double share = 0.0;
  std::vector<EffectSet> sets;
  int count = 0;
};

// Deals out sets and sizes: every set once before any comes again, with another size each time.
class Dealer {
 public:
  Dealer(std::vector<EffectSet> sets, std::vector<double> severities, std::uint64_t seed)
      : sets_(std::move(sets)), severities_(std::move(severities)), seed_(seed) {}

  std::pair<EffectSet, double> Next() {
    const std::size_t round = dealt_ / sets_.size();
    const std::size_t place = dealt_ % sets_.size();
    if (place == 0) order_ = Shuffled(sets_.size(), round);
    ++dealt_;
    const std::size_t chosen = order_[place];
    const std::size_t size = (UnitSeed(seed_, "first size", chosen) + round) % severities_.size();
    return {sets_[chosen], severities_[size]};
  }

 private:
  std::vector<std::size_t> Shuffled(std::size_t count, std::size_t round) const {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::uint64_t> rank(count);
    for (std::size_t i = 0; i < count; ++i) {
      rank[i] = UnitSeed(seed_, "order of round " + std::to_string(round), i);
    }
    std::ranges::sort(order, {}, [&](std::size_t i) { return rank[i]; });
    return order;
  }

  std::vector<EffectSet> sets_;
  std::vector<double> severities_;
  std::uint64_t seed_;
  std::vector<std::size_t> order_;
  std::size_t dealt_ = 0;
};

const RigEffect& Find(const std::vector<RigEffect>& effects, const std::string& id) {
  const auto found = std::ranges::find(effects, id, &RigEffect::id);
  if (found == effects.end()) {
    throw std::invalid_argument(
        id + ", expected catalogue, outside, none, pairs, or effects that howl_rig --list shows");
  }
  return *found;
}

EffectSet Split(const std::string& text) {
  EffectSet out;
  std::size_t from = 0;
  while (true) {
    const std::size_t to = text.find('+', from);
    out.push_back(text.substr(from, to - from));
    if (to == std::string::npos) return out;
    from = to + 1;
  }
}

// Pairs whose members act on different blocks, so that each can be found on its own.
std::vector<EffectSet> Pairs(const std::vector<RigEffect>& effects) {
  std::vector<EffectSet> out;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    for (std::size_t j = i + 1; j < effects.size(); ++j) {
      if (!effects[i].in_catalogue || !effects[j].in_catalogue) continue;
      if (effects[i].block == effects[j].block) continue;
      out.push_back({effects[i].id, effects[j].id});
    }
  }
  return out;
}

std::vector<Group> MakeGroups(const TrialOptions& options, const std::vector<RigEffect>& effects) {
  std::vector<Group> groups;
  Group named{0.6, {}, 0};
  for (const std::string& text : options.effects) {
    if (text == "none") {
      groups.push_back({0.15, {{}}, 0});
    } else if (text == "pairs") {
      groups.push_back({0.1, Pairs(effects), 0});
    } else if (text == "catalogue" || text == "outside") {
      Group group{text == "catalogue" ? 0.6 : 0.15, {}, 0};
      for (const RigEffect& effect : effects) {
        if (effect.in_catalogue == (text == "catalogue")) group.sets.push_back({effect.id});
      }
      groups.push_back(std::move(group));
    } else {
      named.sets.push_back(Split(text));
      for (const std::string& id : named.sets.back()) Find(effects, id);
    }
  }
  if (!named.sets.empty()) groups.push_back(std::move(named));
  return groups;
}

// Whole numbers in the shares' proportions, by the method of largest remainders.
void Apportion(int cases, std::vector<Group>& groups) {
  double total = 0.0;
  for (const Group& group : groups) total += group.share;
  std::vector<std::pair<double, std::size_t>> remainders;
  int given = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double exact = cases * groups[g].share / total;
    groups[g].count = static_cast<int>(std::floor(exact));
    given += groups[g].count;
    remainders.emplace_back(static_cast<double>(groups[g].count) - exact, g);
  }
  std::ranges::sort(remainders);
  for (const auto& [remainder, g] : remainders) {
    if (given == cases) break;
    ++groups[g].count;
    ++given;
  }
}

}  // namespace

std::vector<CasePlan> PlanCases(const TrialOptions& options,
                                const std::vector<RigEffect>& effects) {
  std::vector<Group> groups = MakeGroups(options, effects);
  if (groups.empty() || options.severities.empty()) {
    throw std::invalid_argument("a trial needs at least one effect and one size");
  }
  Apportion(options.cases, groups);
  std::vector<CasePlan> plans;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].sets.empty()) continue;
    Dealer dealer(groups[g].sets, options.severities, UnitSeed(options.seed, "group", g));
    for (int i = 0; i < groups[g].count; ++i) {
      auto [set, severity] = dealer.Next();
      plans.push_back({"", std::move(set), severity, 0});
    }
  }
  // The order must not reveal the effects: cases are numbered after they are shuffled.
  std::vector<std::pair<std::uint64_t, std::size_t>> ranks;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    ranks.emplace_back(UnitSeed(options.seed, "number of case", i), i);
  }
  std::ranges::sort(ranks);
  std::vector<CasePlan> out;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    CasePlan plan = std::move(plans[ranks[i].second]);
    char name[32];
    std::snprintf(name, sizeof(name), "case%03zu", i + 1);
    plan.name = name;
    plan.rig_seed = UnitSeed(options.seed, plan.name);
    out.push_back(std::move(plan));
  }
  return out;
}

}  // namespace howl
