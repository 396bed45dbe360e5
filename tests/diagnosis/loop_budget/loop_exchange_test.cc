// Another item in the place of one that came first.
#include "diagnosis/loop_budget/search/loop_exchange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/trials/shared_effect_trial.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::loop_exchange_test {
namespace {

std::vector<LoopItem> ItemsOf(const std::string& id) {
  std::vector<LoopItem> out;
  std::ranges::copy_if(AllLoopItems(), std::back_inserter(out),
                       [&](const LoopItem& item) { return item.id == id; });
  return out;
}

std::vector<LoopRival> RivalsOf(const std::string& id, double behind) {
  std::vector<LoopRival> out;
  for (const LoopItem& item : ItemsOf(id)) out.push_back({item, behind});
  return out;
}

// q through a low-pass, for which a mode far above the band came first: it leads q nearly as much.
TEST(LoopExchange, PutsTheInstrumentInThePlaceOfAMode) {
  const LoopRecords records(
      DuctsAt({1.2, 1.5, 1.8}, [](Record* record) { LowPass(2000.0, record); }), 0);
  const LoopForm base = DuctsForm();
  LoopBudgetOptions options;
  options.starts = 4;
  const LoopFit without = DuctsFit(records, options);
  const LoopItem mode = ItemsOf("extra_acoustic_mode").at(0);
  const LoopTrial trial = TryAll(records, without, 0.0, {mode}, "mode/", options)[0];
  const LoopFit with_mode =
      FitLoopFrom(records, trial.model, trial.starts, MaximumTaken::kBest, "mode/", options);
  ASSERT_GT(with_mode.Density(), without.Density() + 100.0);
  // However far behind they were, what stood beside the mode when it came has gone since.
  const std::vector<LoopRival> behind = RivalsOf("q_sensor_lowpass", 1e6);
  LoopStanding now{with_mode, {{mode, 6.0, 0.0, behind, 1, with_mode}}, {without}};
  std::optional<LoopStanding> next = BestExchange(records, base, "first/", options, &now);
  ASSERT_TRUE(next.has_value());
  ASSERT_EQ(next->steps.size(), 1u);
  const LoopStep& step = next->steps[0];
  EXPECT_EQ(step.item.id, "q_sensor_lowpass");
  EXPECT_EQ(step.least, 6.0);
  // The instrument's value, which all points share, has its price.
  EXPECT_GT(step.price, 0.0);
  EXPECT_GT(next->best.Density(), with_mode.Density());
  EXPECT_EQ(next->best.model.structure.modes, 2);
  EXPECT_TRUE(std::ranges::any_of(
      step.rivals, [&](const LoopRival& each) { return KeyOf(each.item) == KeyOf(mode); }));
  // The other way round the mode is no better, and no longer one of a class.
  next->without = {without};
  EXPECT_FALSE(BestExchange(records, base, "second/", options, &*next).has_value());
  EXPECT_TRUE(next->steps[0].equals.empty());
  // Where all stands as it did then, what was far behind is not tried again.
  LoopStanding same{with_mode, {{mode, 6.0, 0.0, behind, 0, with_mode}}, {without}};
  EXPECT_FALSE(BestExchange(records, base, "third/", options, &same).has_value());
}

}  // namespace
}  // namespace howl::loop_exchange_test
