// The profile of the evidence over a shared effect's values, against fits at values beside its top.
#include "diagnosis/loop_budget/trials/effect_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/forms/shared_effect.h"
#include "diagnosis/loop_budget/trials/loop_starts.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::effect_profile_test {
namespace {

constexpr double kLeak = 0.1;
// Of each point's maximum: as near as its arithmetic allows.
constexpr PointFitOptions kExact{.iterations = 400, .converged = 1e-9};

// A leak moves acoustics and flame with it, far more than the records leave open.
std::vector<LoopRecord> LeakingDucts() {
  return DuctsAt({1.2, 1.5, 1.8}, [](Record* record) { Leak(kLeak, record); });
}

LoopItem ItemOf(const std::string& id) {
  return *std::ranges::find(AllLoopItems(), id, &LoopItem::id);
}

class EffectProfileTest : public ::testing::Test {
 protected:
  EffectProfileTest() : records_(LeakingDucts(), 0) {
    options_.starts = 4;
    fit_ = DuctsFit(records_, options_);
  }

  LoopRecords records_;
  LoopBudgetOptions options_;
  LoopFit fit_;
};

TEST_F(EffectProfileTest, EndsAtItsTop) {
  EffectProfile profile(records_, fit_, ItemOf("crosstalk_p_to_q"), MaximumKnown::kClosely, "",
                        options_);
  const ProfileMaximum found = profile.From(profile.Begin(ParametersOf(fit_)).front());
  const double deviation = found.Deviations()[0];
  const auto value_at = [&](double deviations) {
    Eigen::VectorXd u = found.at.u;
    u[0] += deviations * deviation;
    return profile.At(u, ParametersOf(found.at.fits), kExact, RecordExtent::kWhole).log_posterior;
  };
  const double below = value_at(-1.0);
  const double here = value_at(0.0);
  const double above = value_at(1.0);
  // Half a nat lower on either side, and alike on both: the top is within a tenth of a deviation.
  EXPECT_NEAR(0.5 * (above - below), 0.0, 0.1);
  EXPECT_NEAR(2.0 * here - above - below, 1.0, 0.1);
}

TEST_F(EffectProfileTest, ComesToTheSameTopFromAfar) {
  EffectProfile profile(records_, fit_, ItemOf("crosstalk_p_to_q"), MaximumKnown::kClosely, "",
                        options_);
  std::vector<double> tops;
  double deviation = 0.0;
  for (const double begin : {-0.2, 0.0, 0.4}) {
    const Eigen::VectorXd u = Eigen::VectorXd::Constant(1, begin);
    const ProfileMaximum found = profile.From(profile.At(u, ParametersOf(fit_)));
    tops.push_back(found.at.u[0]);
    deviation = found.Deviations()[0];
  }
  EXPECT_NEAR(tops[0], tops[1], 0.2 * deviation);
  EXPECT_NEAR(tops[2], tops[1], 0.2 * deviation);
}

// A trial's top is as high as that of an estimate but for what it need not know.
TEST(EffectProfile, EndsRoughlyAtItsTop) {
  const LoopRecords records(
      DuctsAt({1.2, 1.5, 1.8}, [](Record* record) { LowPass(2000.0, record); }), 0);
  LoopBudgetOptions options;
  options.starts = 4;
  const LoopFit fit = DuctsFit(records, options);
  double without = 0.0;
  for (const PointFit& each : fit.fit.points) without += each.log_posterior;
  const auto top = [&](MaximumKnown known) {
    EffectProfile profile(records, fit, ItemOf("q_sensor_lowpass"), known, "", options);
    return profile.From(profile.Begin(ParametersOf(fit)).front()).at.log_posterior;
  };
  const double closely = top(MaximumKnown::kClosely);
  ASSERT_GT(closely, without + 400.0);
  EXPECT_NEAR(top(MaximumKnown::kRoughly), closely, 3.0 * UnknownOfTrial(closely - without));
}

}  // namespace
}  // namespace howl::effect_profile_test
