// Where a verdict of records lies.
#include "diagnosis/loop_budget/loop_places.h"

#include <gtest/gtest.h>

namespace howl::loop_places_test {
namespace {

// Of a loop that nothing describes, with a gap left in the acoustics.
LoopDiagnosis Unknown(double acoustics_nats, double flame_nats) {
  LoopDiagnosis out;
  out.diagnosis.kind = VerdictKind::kUnknown;
  out.diagnosis.budget.emplace();
  out.diagnosis.budget->everywhere.low_hz = 30.0;
  out.diagnosis.budget->everywhere.high_hz = 1200.0;
  Place left;
  left.block = LoopBlock::kAcoustics;
  left.share = 1.0;
  out.diagnosis.budget->left = {left};
  out.acoustics.nats = acoustics_nats;
  out.flame.nats = flame_nats;
  return out;
}

TEST(PlacesOf, AreTheCutsThatErrAtTheLines) {
  const std::vector<Place> flame = PlacesOf(Unknown(2.0, 500.0), 3.7);
  ASSERT_EQ(flame.size(), 1u);
  EXPECT_EQ(flame[0].block, LoopBlock::kFlame);
  EXPECT_EQ(flame[0].share, 1.0);
  EXPECT_EQ(flame[0].high_hz, 1200.0);
  const std::vector<Place> both = PlacesOf(Unknown(30.0, 90.0), 3.7);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].block, LoopBlock::kFlame);
  EXPECT_NEAR(both[0].share, 0.75, 1e-12);
  EXPECT_EQ(both[1].block, LoopBlock::kAcoustics);
}

TEST(PlacesOf, AreWhereTheGapIsLeftWhereNoLineErrs) {
  const std::vector<Place> out = PlacesOf(Unknown(-1.0, 3.0), 3.7);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].block, LoopBlock::kAcoustics);
}

// What is named has a place of its own, whatever errs beside it.
TEST(PlacesOf, AreThoseOfWhatIsNamed) {
  LoopDiagnosis found = Unknown(0.0, 0.0);
  found.diagnosis.kind = VerdictKind::kEffect;
  BudgetEntry entry;
  entry.lost_nats = 40.0;
  entry.place.block = LoopBlock::kDelay;
  found.diagnosis.budget->entries = {entry};
  const std::vector<Place> out = PlacesOf(found, 3.7);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].block, LoopBlock::kDelay);
}

}  // namespace
}  // namespace howl::loop_places_test
