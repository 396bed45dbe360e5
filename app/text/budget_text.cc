#include "app/text/budget_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "app/text/text_table.h"

namespace howl {
namespace {

constexpr double kWidth = 40.0;

std::string Bar(const BudgetEntry& entry, double whole) {
  const auto cells = [&](double gap) {
    return static_cast<std::size_t>(
        std::lround(kWidth * std::clamp(gap / std::max(whole, 1e-12), 0.0, 1.0)));
  };
  const std::size_t stays = cells(entry.gap_after);
  const std::size_t was = std::max(cells(entry.gap_before), stays);
  return std::string(stays, '#') + std::string(was - stays, '.');
}

}  // namespace

std::string ParameterText(const std::vector<EstimatedParameter>& parameters) {
  std::string text;
  for (const EstimatedParameter& parameter : parameters) {
    if (!text.empty()) text += ", ";
    text += parameter.name + " " + Significant(parameter.value, 4);
    if (!parameter.unit.empty()) text += " " + parameter.unit;
    if (parameter.at_bound) text += " (at bound)";
  }
  return text;
}

std::string BudgetText(const Budget& budget) {
  std::string out = "budget, left out: several causes take the gap from " +
                    Fixed(budget.gap_before, 3) + " to " + Fixed(budget.gap_left, 3) + "\n";
  TextTable table({"item", "gap after", "", "lost without: nats", "gap", "points", "estimate"});
  for (const BudgetEntry& entry : budget.entries) {
    std::string names = entry.item;
    for (const std::string& other : entry.equals) names += " = " + other;
    table.AddRow(
        {names, Fixed(entry.gap_after, 3), Bar(entry, budget.gap_before), Fixed(entry.lost_nats, 1),
         Fixed(entry.lost_gap, 3),
         std::to_string(entry.experiments_better) + "/" + std::to_string(budget.experiments),
         ParameterText(entry.parameters)});
  }
  out += table.Text();
  for (const Place& place : budget.left) {
    const bool acoustics = place.block == LoopBlock::kAcoustics;
    out += "left: " + std::string(acoustics ? "p from q, " : "q from p, ") +
           Fixed(place.low_hz, 0) + " to " + Fixed(place.high_hz, 0) + " Hz, " +
           std::to_string(place.experiments.size()) + " experiments (share " +
           Fixed(place.share, 2) + ")\n";
  }
  return out;
}

}  // namespace howl
