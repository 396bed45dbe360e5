// The budget of the gap between model and rig: what was added to the base, effect, source of noise
// or freedom of the acoustics, one item after the other until nothing more paid; how far each took
// the gap; and what is left.
//
// The gap is that of held_out_score.h; all structures are measured against the ceiling of that
// which leaves least (common_ceiling.h).
#ifndef HOWL_DIAGNOSIS_VERDICT_BUDGET_H_
#define HOWL_DIAGNOSIS_VERDICT_BUDGET_H_

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/fit/estimated_parameter.h"
#include "diagnosis/held_out/octave_gaps.h"

namespace howl {

struct BudgetEntry {
  std::string item;  // loop_item.h
  std::string form;  // of an item that has several, as configs tell it: "side before_flame"
  double gap_before = 0.0;
  double gap_after = 0.0;
  // What is lost when this item alone is taken away and the rest fitted anew.
  double lost_nats = 0.0;  // of what the other points foretell
  double lost_gap = 0.0;
  // Nats of what was left out; NaN where halves are not fitted.
  std::array<double, 2> lost_on_halves = {};
  std::size_t experiments_better = 0;  // with the item, of what was left out
  // Items that in the end, in its place, foretell as well within the odds of a class (odds.h).
  std::vector<std::string> equals;
  std::vector<EstimatedParameter> parameters;
  // The item's block, and where the loop without it falls short; everywhere where it nowhere does.
  Place place;
};

// An item that the base was given (loop_budget/search/given_items.h).
struct GivenItem {
  std::string item;
  std::string form;
  std::vector<EstimatedParameter> parameters;  // beside all that the best loop has
};

// An effect that the samples themselves show (loop_budget/sample_facts.h).
struct SampleFact {
  std::string effect;
  // Of clipping the share of samples at the range's ends; levels; of dropouts the samples of the
  // longest; of hum its amplitude over the cycle's.
  double value = 0.0;
  std::size_t experiments = 0;
  // Whether it adds to the samples what the base has, white noise of p (fine_steps.h), or what no
  // fit sees (hum_below_band.h), or they are made good (mended_records.h).
  bool rest_can_be_found = false;
  LoopBlock block = LoopBlock::kPressureInstrument;
  double line_hz = 0.0;  // of hum; 0: it is at all frequencies
};

// What an item that was not found may still be (loop_budget/account/item_bounds.h), at 95 %.
struct ItemBound {
  std::string item;
  std::string form;
  std::string name;  // of its value
  std::string unit;
  double low = 0.0;  // infinite: not bounded
  double high = 0.0;
};

// The loop with all entries, as far as a config can state it (loop_budget/account/stated_loop.h).
// What the records have of instruments is as `record` of each experiment states it.
struct StatedLoop {
  std::string model;              // model: {...}
  bool is_another_model = false;  // than the config's
  bool own_delays = false;        // which the paper's loop must state as well
  std::string pressure_response;
  std::string heat_release_response;
  double delay_s = 0.0;
  std::vector<double> pressure_in_heat_release;  // of each experiment; empty: of none
  std::vector<std::string> not_stated;           // items

  bool ChangesRecords() const {
    return !pressure_response.empty() || !heat_release_response.empty() || delay_s != 0.0 ||
           !pressure_in_heat_release.empty();
  }
  bool SaysMore() const { return is_another_model || own_delays || ChangesRecords(); }
};

struct Budget {
  std::vector<SampleFact> seen_in_samples;
  std::vector<GivenItem> given;
  std::vector<BudgetEntry> entries;
  std::vector<ItemBound> not_found;  // where the loop is known
  // Of the config's loop; where the budget began with items that were given, of that with them.
  double gap_before = 0.0;
  std::optional<double> gap_without_given;  // of the config's loop, then
  double gap_left = 0.0;
  double floor = 0.0;       // of the gap that is left (held_out_score.h)
  std::vector<Place> left;  // where: acoustics for p given q, flame for q given p
  std::vector<OctaveGap> left_by_octave;
  // Relative errors that the model still needs, of p given q and of q given p.
  double acoustic_error = 0.0;
  double flame_error = 0.0;
  std::size_t experiments = 0;
  Place everywhere;  // all operating points and bands
  StatedLoop stated;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_VERDICT_BUDGET_H_
