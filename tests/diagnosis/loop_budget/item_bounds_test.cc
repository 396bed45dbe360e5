// How large what was not found may be, against profiles at its ends and against what was put in.
#include "diagnosis/loop_budget/account/item_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/trials/effect_profile.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::item_bounds_test {
namespace {

const ItemBound& Of(const std::vector<ItemBound>& bounds, const std::string& item) {
  return *std::ranges::find(bounds, item, &ItemBound::item);
}

// Ducts whose q holds this share of p, of which the loop does not know.
LoopRecords Leaking(double leak, std::uint64_t seed, double duration_s) {
  std::vector<LoopRecord> ducts;
  for (const double gain : {1.2, 1.5, 1.8}) {
    ducts.push_back(DuctAt(gain, duration_s, 100 * seed + static_cast<std::uint64_t>(10.0 * gain),
                           [&](Record* record) { Leak(leak, record); }));
  }
  return {ducts, 0};
}

// Where each point is free, as the bounds have it, so that nothing but a leak moves the profile.
TEST(ItemBounds, EndWhereTheProfileHasFallenByHalfTheSquareOfNormalsQuantile) {
  const LoopRecords records = Leaking(0.0, 1, 0.8);
  const LoopBudgetOptions options = Among({"crosstalk_p_to_q"});
  LoopFit fit = DuctsFit(records, options);
  const std::vector<ItemBound> bounds = BoundsBeside(records, fit, fit.model, options);
  ASSERT_EQ(bounds.size(), 1u);
  for (std::size_t e = 0; e < records.size(); ++e) {
    fit.fit.prior[e] = PriorOf(fit.model.structure, records.Whole(fit.model, e));
  }
  const LoopItem item = *std::ranges::find(AllLoopItems(), bounds[0].item, &LoopItem::id);
  EffectProfile profile(records, fit, item, MaximumKnown::kClosely, "", options);
  const ProfileMaximum top = profile.From(profile.At(Eigen::VectorXd::Zero(1), ParametersOf(fit)));
  for (const double end : {bounds[0].low, bounds[0].high}) {
    const double there = profile
                             .At(Eigen::VectorXd::Constant(1, end), ParametersOf(top.at.fits),
                                 PointFitOptions{.converged = 1e-6}, RecordExtent::kWhole)
                             .log_posterior;
    // Half of 1.96 squared; ends are known to 0.4 nats, tops to what three tries showed of them.
    EXPECT_NEAR(top.at.log_posterior - there, 1.92, 0.7) << end;
  }
}

TEST(ItemBounds, HaveNoEndAtANullThatIsOneOfTheRange) {
  const LoopRecords records = Leaking(0.0, 2, 0.8);
  const LoopBudgetOptions options = Among({"q_sensor_lowpass"});
  const LoopFit fit = DuctsFit(records, options);
  const std::vector<ItemBound> bounds = BoundsBeside(records, fit, fit.model, options);
  ASSERT_FALSE(bounds.empty());
  for (const ItemBound& bound : bounds) {
    EXPECT_GT(bound.low, 1000.0) << bound.form;
    EXPECT_TRUE(std::isinf(bound.high)) << bound.form;
  }
}

TEST(ItemBounds, AreOfNothingThatTheLoopHasOrThatIsWithheld) {
  const LoopRecords records = Leaking(0.0, 3, 0.4);
  LoopBudgetOptions options = Among({"crosstalk_p_to_q", "slow_drift"});
  LoopFit fit = DuctsFit(records, options);
  std::vector<ItemBound> bounds = BoundsBeside(records, fit, fit.model, options);
  ASSERT_EQ(bounds.size(), 2u);
  EXPECT_LT(Of(bounds, "slow_drift").low, 0.0);
  EXPECT_GT(Of(bounds, "slow_drift").high, 0.0);
  options.withheld = LoopItemIds();
  EXPECT_TRUE(BoundsBeside(records, fit, fit.model, options).empty());
}

// What was put in lies in the interval as often as that says: on 40 draws of a leak and of none 95
// of 100 times, within what so few draws tell.
TEST(LongItemBounds, HoldWhatIsThere) {
  constexpr int kDraws = 40;
  const LoopBudgetOptions options = Among({"crosstalk_p_to_q", "amplitude_dependent_delay"});
  int leaks = 0;
  int delays = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const double leak = draw % 2 == 0 ? 0.0 : 0.005;
    const LoopRecords records = Leaking(leak, 10 + static_cast<std::uint64_t>(draw), 0.8);
    const LoopFit fit = DuctsFit(records, options);
    const std::vector<ItemBound> bounds = BoundsBeside(records, fit, fit.model, options);
    const ItemBound& of_leak = Of(bounds, "crosstalk_p_to_q");
    if (of_leak.low <= leak && leak <= of_leak.high) ++leaks;
    const ItemBound& of_delay = Of(bounds, "amplitude_dependent_delay");
    if (of_delay.low <= 0.0 && 0.0 <= of_delay.high) ++delays;
  }
  // Fewer than 34 of 40 have a chance of 1 % where each has 95 %.
  EXPECT_GE(leaks, 34);
  EXPECT_GE(delays, 34);
}

}  // namespace
}  // namespace howl::item_bounds_test
