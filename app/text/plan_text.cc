#include "app/text/plan_text.h"

#include <algorithm>
#include <cmath>

#include "app/text/text_table.h"
#include "diagnosis/verdict/verdict.h"

namespace howl {
namespace {

constexpr double kWorthSaying = 0.5;  // nats: odds of 1.4 on a plan's temperature

std::string Value(const PlannedEffect& effect, double value) {
  if (!std::isfinite(value)) return "-";
  const std::string unit = effect.unit.empty() ? "" : " " + effect.unit;
  // Three digits of what differs from the null: a mode's ratio of 3.0004 is not 3.00.
  const double beside = std::abs(value - effect.null_value);
  const double share = effect.from_infinity || !(beside > 0.0) ? 1.0 : std::abs(value) / beside;
  const int digits = 3 + std::clamp(static_cast<int>(std::ceil(std::log10(share) - 1e-9)), 0, 9);
  return Significant(value, digits) + unit;
}

std::string WithName(const PlannedEffect& effect, double value) {
  return std::isfinite(value) ? effect.parameter + " " + Value(effect, value) : "none";
}

// The size from which on the effect is told from all others; NaN where there is one from which it
// is not.
double FromAll(const PlannedEffect& effect) {
  const auto size = [&](double x) {
    return effect.from_infinity ? 1.0 / x : std::abs(x - effect.null_value);
  };
  double most = effect.size.smallest;
  for (const PlannedRival& rival : effect.rivals) {
    if (!std::isfinite(rival.told_apart_at)) return rival.told_apart_at;
    if (size(rival.told_apart_at) > size(most)) most = rival.told_apart_at;
  }
  return most;
}

// The effects of one class are said to be that; empty where nothing else is to be said.
std::string NotToldFrom(const Plan& plan, const PlannedEffect& effect) {
  std::vector<std::string> names;
  for (const PlannedRival& rival : effect.rivals) {
    if (rival.nats > rival.nats_needed) continue;
    const bool one_class = std::ranges::any_of(plan.classes, [&](const auto& members) {
      return std::ranges::find(members, effect.effect) != members.end() &&
             std::ranges::find(members, rival.effect) != members.end();
    });
    if (!one_class) names.push_back(rival.effect);
  }
  if (names.empty()) return "";
  return Wrapped(effect.effect + " at twice its smallest size is not told from " +
                     CommaSeparated(names),
                 2) +
         "\n";
}

std::string PairText(const PlannedPair& pair) {
  const PlannedTrial& best = pair.trials.front();
  const std::string between = pair.effect + " or " + pair.other + ": " + Fixed(pair.nats, 1) +
                              " nats between them, " + Fixed(pair.nats_needed, 1) + " needed; ";
  if (!(best.nats > std::max(pair.nats, kWorthSaying)))
    return Wrapped(between + "no measurement tried separates them", 2);
  return Wrapped(between + best.what +
                     (best.nats > best.nats_needed ? " tells them apart ("
                                                   : " comes nearest to telling them apart (") +
                     Fixed(best.nats, 1) + " of " + Fixed(best.nats_needed, 1) + ")",
                 2);
}

}  // namespace

std::string PlanText(const Plan& plan, const std::string& records) {
  std::string text = "plan for " + records + "\n";
  text += std::string("base: ") + (plan.model.modes == 1 ? "one mode; " : "two modes; ") +
          (plan.model.own_delays ? "delays that may differ" : "one delay for all") + "\n";
  TextTable table({"effect", "seen from", "told from all others from"});
  for (const PlannedEffect& effect : plan.effects) {
    table.AddRow(
        {effect.effect, WithName(effect, effect.size.smallest), Value(effect, FromAll(effect))});
  }
  text += table.Text();
  for (const PlannedEffect& effect : plan.effects) text += NotToldFrom(plan, effect);
  for (const std::vector<std::string>& members : plan.classes) {
    text += Wrapped("one class at twice the smallest size: " + CommaSeparated(members), 2) + "\n";
  }
  if (plan.pairs.empty()) return text + "next: the records tell apart whatever they show\n";
  for (const PlannedPair& pair : plan.pairs) text += "next: " + PairText(pair) + "\n";
  return text;
}

}  // namespace howl
