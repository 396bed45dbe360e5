#include "diagnosis/loop_budget/account/found_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "diagnosis/held_out/common_ceiling.h"
#include "diagnosis/held_out/octave_gaps.h"
#include "diagnosis/held_out/places_left.h"
#include "diagnosis/loop_budget/account/delay_trend.h"
#include "diagnosis/loop_budget/account/loop_held_out.h"
#include "diagnosis/loop_budget/account/loop_item_parameters.h"
#include "diagnosis/loop_budget/account/stated_loop.h"
#include "diagnosis/loop_budget/forms/odds.h"
#include "estimation/analysis/spectra/half_width.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

// Where an item makes the difference: the bands and the operating points at which the loop without
// it falls short.
Place PlaceOf(const LoopRecords& records, const LoopItem& item, const HeldOutScore& with,
              const HeldOutScore& without, const Place& everywhere) {
  const std::vector<Place> short_of = PlacesLeft(records.names(), Beside(without, with));
  Place out = short_of.empty() ? everywhere : short_of.front();
  out.block = BlockOf(item);
  return out;
}

// The effects that all points share, with the errors of their values, as the entries have them.
std::vector<SharedErrors> SharedErrorsOf(const LoopFound& found,
                                         const std::vector<BudgetEntry>& entries) {
  std::vector<SharedErrors> out;
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    if (!found.steps[i].item.effect) continue;
    SharedErrors errors{found.steps[i].item.effect, {}};
    for (const EstimatedParameter& parameter : entries[i].parameters) {
      errors.deviations.push_back((parameter.high - parameter.low) / (2.0 * HalfWidth95(1.0)));
    }
    out.push_back(std::move(errors));
  }
  return out;
}

// The trend of the points' delays as an entry, where it is worth as much as an item must be.
std::optional<BudgetEntry> DelayTrendIn(const LoopRecords& records, const LoopFound& found,
                                        const Budget& budget, const LoopBudgetOptions& options) {
  const bool withheld =
      std::ranges::find(options.withheld, kDelayTrendId) != options.withheld.end();
  if (!options.one_delay || withheld || records.size() < kFewestOfTrend) return std::nullopt;
  const DelayTrend trend =
      TrendOf(DelaysOf(records, found.best, SharedErrorsOf(found, budget.entries), options));
  const auto offered = static_cast<double>(AllLoopItems().size() + options.declared.size());
  const double beside = LeftByForms(found.best.Density() - found.base.Density());
  if (!(trend.nats > std::log(kOddsOfItem * offered) + beside)) return std::nullopt;
  BudgetEntry out;
  out.item = kDelayTrendId;
  out.lost_nats = trend.nats;
  out.lost_on_halves.fill(std::numeric_limits<double>::quiet_NaN());
  out.experiments_better = trend.points_better;
  out.parameters.push_back({"rel_span", trend.rel_span, trend.low, trend.high, ""});
  out.place = budget.everywhere;
  out.place.block = LoopBlock::kDelay;
  return out;
}

std::vector<GivenItem> GivenOf(const LoopRecords& records, const LoopFound& found,
                               const LoopBudgetOptions& options) {
  std::vector<GivenItem> out;
  if (!found.without_given) return out;
  auto mode = static_cast<std::size_t>(found.without_given->model.structure.modes);
  for (const LoopItem& item : found.given) {
    out.push_back(
        {item.id, FormOf(item), LoopItemParameters(records, found.best, item, mode, options)});
    if (item.kind == LoopItemKind::kMode) ++mode;
  }
  return out;
}

}  // namespace

std::size_t PointsBetter(const LoopFit& with, const LoopFit& without) {
  std::size_t out = 0;
  for (std::size_t e = 0; e < with.log_density.size(); ++e) {
    if (with.log_density[e] > without.log_density[e]) ++out;
  }
  return out;
}

Budget BudgetOf(const LoopRecords& records, const LoopFound& found,
                const LoopBudgetOptions& options) {
  const HeldOutScore base = ScoreHeldOut(records, found.base, "base/", options);
  // With nothing added the best loop is the base, driven as it was.
  const HeldOutScore best =
      found.steps.empty() ? base : ScoreHeldOut(records, found.best, "best/", options);
  std::vector<HeldOutScore> after(found.steps.size());
  std::vector<HeldOutScore> without(found.steps.size());
  RunUnits(found.steps.size(), options.threads, [&](std::size_t i) {
    const std::string number = std::to_string(i) + "/";
    after[i] = ScoreHeldOut(records, found.steps[i].after, "after/" + number, options);
    without[i] = ScoreHeldOut(records, found.without[i], "lost/" + number, options);
  });
  std::optional<HeldOutScore> without_given;
  if (found.without_given) {
    without_given = ScoreHeldOut(records, *found.without_given, "without_given/", options);
  }
  CommonCeiling ceiling;
  if (without_given) ceiling.Lower(*without_given);
  ceiling.Lower(base);
  ceiling.Lower(best);
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    ceiling.Lower(after[i]);
    ceiling.Lower(without[i]);
  }
  Budget out;
  out.experiments = records.size();
  out.everywhere = Everywhere(records.names(), base);
  out.gap_before = ceiling.Gap(base);
  out.gap_left = ceiling.Gap(best);
  if (without_given) out.gap_without_given = ceiling.Gap(*without_given);
  out.given = GivenOf(records, found, options);
  double before = out.gap_before;
  auto mode = static_cast<std::size_t>(found.base.model.structure.modes);
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    const LoopStep& step = found.steps[i];
    BudgetEntry entry;
    entry.item = step.item.id;
    entry.form = FormOf(step.item);
    entry.gap_before = before;
    entry.gap_after = ceiling.Gap(after[i]);
    before = entry.gap_after;
    entry.lost_nats = found.best.Density() - found.without[i].Density();
    entry.lost_gap = ceiling.Gap(without[i]) - out.gap_left;
    for (std::size_t half = 0; half < 2; ++half) {
      entry.lost_on_halves[half] = best.Nats(half) - without[i].Nats(half);
    }
    entry.experiments_better = PointsBetter(found.best, found.without[i]);
    entry.place = PlaceOf(records, step.item, best, without[i], out.everywhere);
    entry.equals = step.equals;
    // Jumps at random times have the same spectrum, and so have sidebands of a delay that wanders.
    if (step.item.id == "parametric_noise") {
      entry.equals.insert(entry.equals.end(), {"intermittency", "delay_wander"});
    }
    entry.parameters = LoopItemParameters(records, found.best, step.item, mode, options);
    if (step.item.kind == LoopItemKind::kMode) ++mode;
    out.entries.push_back(std::move(entry));
  }
  out.stated = StatedLoopOf(records, found, out);
  if (std::optional<BudgetEntry> trend = DelayTrendIn(records, found, out, options)) {
    trend->gap_before = trend->gap_after = before;
    out.stated.own_delays = true;
    out.entries.push_back(std::move(*trend));
  }
  const HeldOutScore left = ceiling.Against(best);
  if (out.gap_left > 0.0) out.left = PlacesLeft(records.names(), left);
  out.floor = left.Floor();
  out.left_by_octave = GapsByOctave(records.names(), records.cycle_hz(), left);
  return out;
}

}  // namespace howl
