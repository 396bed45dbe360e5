#include "diagnosis/loop_budget/why_unknown.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/loop_budget/forms/odds.h"
#include "model/effects/catalogue.h"

namespace howl {

std::string HalfThatSpeaksAgainst(const Budget& budget) {
  for (const BudgetEntry& entry : budget.entries) {
    for (const double lost : entry.lost_on_halves) {
      if (lost < -std::log(kOddsOfItem)) {
        return "one half of the records is foretold better without " + entry.item;
      }
    }
  }
  return "";
}

std::string ValueThatCannotBe(const Budget& budget) {
  for (const BudgetEntry& entry : budget.entries) {
    for (const EffectPointer& effect : Catalogue()) {
      if (effect->id() != entry.item) continue;
      for (const EstimatedParameter& estimate : entry.parameters) {
        const auto known =
            std::ranges::find(effect->parameters(), estimate.name, &EffectParameter::name);
        if (known == effect->parameters().end() || !known->unit.empty()) continue;
        if (estimate.value < known->low || estimate.value > known->high) {
          return entry.item + " would have a " + estimate.name + " that it cannot have";
        }
      }
    }
  }
  return "";
}

std::string WhyUnknown(const Budget& budget, bool errs_at_lines, std::ptrdiff_t named) {
  if (errs_at_lines) return "the best loop still errs at the cycle's lines";
  if (budget.gap_left > budget.floor) {
    return "of what the best loop misses a free transfer foretells more than errors of its "
           "parameters explain";
  }
  if (budget.floor > kMostFloor) {
    return "half a record leaves the loop's parameters so uncertain that a wrong loop could not be "
           "told from a right one";
  }
  if (named > kMostNamed) return "so many items together can imitate what none of them is";
  if (std::string half = HalfThatSpeaksAgainst(budget); !half.empty()) return half;
  return ValueThatCannotBe(budget);
}

}  // namespace howl
