#include "diagnosis/verdict/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace howl::verdict_test {
namespace {

TEST(Verdict, FollowsTheEvidence) {
  Evidence nothing;
  nothing.gap_before = nothing.gap_after = nothing.gap_floor = 0.05;
  EXPECT_GT(Weigh(nothing).none, 0.95);
  Evidence noisy = nothing;
  noisy.gap_before = noisy.gap_after = 0.3;
  EXPECT_LT(Weigh(noisy).none, 0.05);
  EXPECT_GT(Weigh(noisy).unknown, 0.95);
  Evidence found = nothing;
  found.gain = 500.0;
  found.gap_before = 0.5;
  EXPECT_LT(Weigh(found).none, 0.05);
  EXPECT_LT(Weigh(found).unknown, 0.05);
  Evidence poor = found;
  poor.acoustic_slack = 400.0;
  EXPECT_GT(Weigh(poor).unknown, 0.95);
  Evidence far = found;
  far.gap_after = 0.3;
  EXPECT_GT(Weigh(far).unknown, 0.95);
  // Few levels take nothing off the likelihood, yet there they are.
  Evidence steps = nothing;
  steps.model_free = true;
  EXPECT_EQ(Weigh(steps).none, 0.0);
  EXPECT_EQ(Weigh(steps).unknown, 0.0);
  Evidence misfit = found;
  misfit.form_is_wrong = true;
  EXPECT_GT(Weigh(misfit).unknown, 0.85);
  Evidence line = nothing;
  line.unexplained_lines = true;
  EXPECT_GT((1.0 - Weigh(line).none) * Weigh(line).unknown, 0.85);
}

TEST(Verdict, WhatAPlaceboDoesAsWellIsNoCause) {
  EXPECT_TRUE(IsNoBetterThanPlacebo(0.26, 0.33));
  EXPECT_FALSE(IsNoBetterThanPlacebo(0.90, 0.38));
  EXPECT_FALSE(IsNoBetterThanPlacebo(-0.10, 0.01));
  EXPECT_FALSE(IsNoBetterThanPlacebo(0.2, std::nan("")));
  EXPECT_FALSE(IsNoBetterThanPlacebo(std::nan(""), std::nan("")));
}

TEST(Verdict, WhatNoiseReachesIsNoDetection) {
  Evidence evidence;
  evidence.gain = 30.0;
  evidence.gap_before = 0.05;
  evidence.gap_after = 0.05;
  evidence.gap_floor = 0.05;
  EXPECT_LT(Weigh(evidence).none, 0.05);
  evidence.gain_of_noise = 36.0;
  EXPECT_GT(Weigh(evidence).none, 0.9);
}

}  // namespace
}  // namespace howl::verdict_test
