// The gap of right predictions against estimates of the ceiling that scatter.
#include "diagnosis/held_out/common_ceiling.h"

#include <gtest/gtest.h>

#include "model/noise/random_stream.h"

namespace howl::common_ceiling_test {
namespace {

constexpr std::size_t kBands = 60;  // of p, then of q
constexpr double kScatter = 0.15;

// Of a structure whose errors are `error` where the best possible are 1.
HeldOutScore ScoreOf(double error, RandomStream* random) {
  HeldOutScore out;
  out.errors.resize(6);
  for (auto& point : out.errors) {
    for (std::vector<BandErrors>& half : point) {
      for (std::size_t i = 0; i < kBands; ++i) {
        half.push_back({.error = error, .ceiling = 1.0 + kScatter * random->Normal()});
      }
    }
  }
  return out;
}

TEST(CommonCeiling, IsNoLuckyEstimate) {
  RandomStream random(1);
  std::vector<HeldOutScore> scores;
  for (int i = 0; i < 20; ++i) scores.push_back(ScoreOf(1.0, &random));
  CommonCeiling ceiling;
  for (const HeldOutScore& score : scores) ceiling.Lower(score);
  for (const HeldOutScore& score : scores) {
    // The square of the gap is that of the scatter and of the luck of the best of twenty means of
    // 60 bands each.
    EXPECT_NEAR(std::pow(ceiling.Gap(score), 2), 0.06, 0.03);
  }
}

TEST(CommonCeiling, IsThatOfTheStructureWhoseFreeTransfersLeaveLeast) {
  RandomStream random(2);
  HeldOutScore poor = ScoreOf(1.5, &random);
  for (auto& point : poor.errors) {
    for (std::vector<BandErrors>& half : point) {
      for (BandErrors& band : half) band.ceiling *= 1.4;
    }
  }
  const HeldOutScore right = ScoreOf(1.0, &random);
  CommonCeiling ceiling;
  ceiling.Lower(poor);
  ceiling.Lower(right);
  EXPECT_LT(ceiling.Gap(right), 0.25);
  EXPECT_NEAR(ceiling.Gap(poor), std::sqrt(0.5), 0.05);
}

}  // namespace
}  // namespace howl::common_ceiling_test
