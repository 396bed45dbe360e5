#include "app/text/budget_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>

#include "app/text/place_text.h"
#include "app/text/text_table.h"

namespace howl {
namespace {

constexpr double kWidth = 40.0;

std::string WithForm(const std::string& item, const std::string& form) {
  return form.empty() ? item : item + " (" + form + ")";
}

std::string Bar(const BudgetEntry& entry, double whole) {
  const auto cells = [&](double gap) {
    return static_cast<std::size_t>(
        std::lround(kWidth * std::clamp(gap / std::max(whole, 1e-12), 0.0, 1.0)));
  };
  const std::size_t stays = cells(entry.gap_after);
  const std::size_t was = std::max(cells(entry.gap_before), stays);
  return std::string(stays, '#') + std::string(was - stays, '.');
}

// "f / 4", "f / 2", "f", "2 f", ...
std::string OctaveText(int octave) {
  const std::string factor = std::to_string(1 << std::abs(octave));
  if (octave == 0) return "f";
  return octave < 0 ? "f / " + factor : factor + " f";
}

// A row a point and signal, a column an octave about the cycle's frequency f.
std::string OctavesText(const std::vector<OctaveGap>& gaps) {
  std::map<int, std::size_t> columns;
  for (const OctaveGap& each : gaps) columns[each.octave] = 0;
  std::vector<std::string> head = {"gap left at", "of"};
  for (auto& [octave, column] : columns) {
    column = head.size();
    head.push_back(OctaveText(octave));
  }
  TextTable table(head);
  std::vector<std::string> row;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (row.empty()) {
      row.assign(head.size(), "");
      row[0] = gaps[i].experiment;
      row[1] = gaps[i].block == LoopBlock::kAcoustics ? "p from q" : "q from p";
    }
    row[columns[gaps[i].octave]] = Fixed(gaps[i].gap, 2);
    const bool last = i + 1 == gaps.size() || gaps[i + 1].experiment != gaps[i].experiment ||
                      gaps[i + 1].block != gaps[i].block;
    if (!last) continue;
    table.AddRow(row);
    row.clear();
  }
  return table.Text();
}

std::string WaterfallText(const Budget& budget) {
  TextTable table({"item", "gap after", "", "lost without: nats", "gap", "points", "estimate"});
  for (const BudgetEntry& entry : budget.entries) {
    std::string names = WithForm(entry.item, entry.form);
    for (const std::string& other : entry.equals) names += " = " + other;
    table.AddRow(
        {names, Fixed(entry.gap_after, 3), Bar(entry, budget.gap_before), Fixed(entry.lost_nats, 1),
         Fixed(entry.lost_gap, 3),
         std::to_string(entry.experiments_better) + "/" + std::to_string(budget.experiments),
         ParameterText(entry.parameters)});
  }
  return table.Text();
}

// Both halves of each record are foretold by fits of the other one.
std::string DoubtfulText(const Budget& budget) {
  std::vector<std::string> items;
  for (const BudgetEntry& entry : budget.entries) {
    if (std::ranges::min(entry.lost_on_halves) <= 0.0) items.push_back(entry.item);
  }
  if (items.empty()) return "";
  return "doubtful, as one half of the records is foretold no better with it: " +
         CommaSeparated(items) + "\n";
}

std::string SizeText(const SampleFact& fact) {
  if (fact.effect == "quantisation") return Fixed(fact.value, 0) + " levels";
  if (fact.effect.ends_with("dropouts")) return "up to " + Fixed(fact.value, 0) + " samples long";
  if (fact.effect == "mains_hum") {
    return Significant(100.0 * fact.value, 2) + " % of the cycle at " + Fixed(fact.line_hz, 0) +
           " Hz, below the band of the fits";
  }
  return Significant(100.0 * fact.value, 2) + " % at the ends of the range";
}

std::string SeenText(const Budget& budget) {
  std::string out;
  for (const SampleFact& fact : budget.seen_in_samples) {
    out += "seen in the samples: " + fact.effect + ", " + SizeText(fact) + ", in " +
           std::to_string(fact.experiments) + " of " + std::to_string(budget.experiments) +
           " records\n";
  }
  return out;
}

std::string GivenText(const std::vector<GivenItem>& given) {
  if (given.empty()) return "";
  TextTable table({"given", "estimate"});
  for (const GivenItem& each : given) {
    table.AddRow({WithForm(each.item, each.form), ParameterText(each.parameters)});
  }
  return table.Text();
}

std::string NotFoundText(const std::vector<ItemBound>& bounds) {
  if (bounds.empty()) return "";
  const auto with_unit = [](double value, const std::string& unit) {
    if (!std::isfinite(value)) return std::string("-");
    return Significant(value, 2) + (unit.empty() ? "" : " " + unit);
  };
  TextTable table({"not found", "value", "at least", "at most (95 %)"});
  for (const ItemBound& bound : bounds) {
    table.AddRow({WithForm(bound.item, bound.form), bound.name, with_unit(bound.low, bound.unit),
                  with_unit(bound.high, bound.unit)});
  }
  return table.Text();
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
  std::string out = SeenText(budget);
  if (budget.gap_without_given) {
    out += "with the items that were given the gap, left out, goes from " +
           Fixed(*budget.gap_without_given, 3) + " to " + Fixed(budget.gap_before, 3) + "\n" +
           GivenText(budget.given);
  }
  out += budget.entries.empty()
             ? "gap, left out: " + Fixed(budget.gap_left, 3) + "\n"
             : "budget, left out: what is named takes the gap from " + Fixed(budget.gap_before, 3) +
                   " to " + Fixed(budget.gap_left, 3) + "\n" + WaterfallText(budget) +
                   DoubtfulText(budget);
  for (const Place& place : budget.left) {
    const bool acoustics = place.block == LoopBlock::kAcoustics;
    out +=
        "left: " + std::string(acoustics ? "p from q, " : "q from p, ") + ExtentText(place) + "\n";
  }
  out += "floor of the gap, of a loop that is right: " + Fixed(budget.floor, 3) + "\n";
  if (budget.gap_left > budget.floor) out += OctavesText(budget.left_by_octave);
  return out + NotFoundText(budget.not_found);
}

}  // namespace howl
