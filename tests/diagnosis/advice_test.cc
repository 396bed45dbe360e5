#include "diagnosis/verdict/advice.h"

#include <gtest/gtest.h>

namespace howl::advice_test {
namespace {

Diagnosis Named(double gain) {
  Diagnosis out;
  out.kind = VerdictKind::kEffect;
  out.effect = "channel_skew";
  out.candidates.resize(1);
  out.candidates[0].gain = gain;
  return out;
}

TEST(Advice, WhatNoiseMightGainCallsForTheBootstrap) {
  EXPECT_NE(Advice(Named(30.0), false).find("--bootstrap"), std::string::npos);
  EXPECT_EQ(Advice(Named(3000.0), false).find("--bootstrap"), std::string::npos);
  EXPECT_EQ(Advice(Named(30.0), true).find("--bootstrap"), std::string::npos);
  Diagnosis done = Named(30.0);
  done.bootstrap_gains = {1.0};
  EXPECT_EQ(Advice(done, false).find("--bootstrap"), std::string::npos);
}

TEST(Advice, TwinsOfTheDelayNeedTheFlamesHighFrequencies) {
  Diagnosis twins = Named(3000.0);
  twins.effect = "delay_dispersion";
  twins.indistinguishable = {"second_delay_path"};
  EXPECT_NE(Advice(twins, false).find("three times the cycle"), std::string::npos);
}

TEST(Advice, SaturationCallsForAWiderRange) {
  Diagnosis clipped = Named(3000.0);
  clipped.effect = "q_clipping";
  EXPECT_NE(Advice(clipped, true).find("range"), std::string::npos);
  clipped.indistinguishable = {"q_clipping+nonlinear_damping"};
  EXPECT_NE(Advice(clipped, true).find("range"), std::string::npos);
  clipped.indistinguishable.clear();
  clipped.effect = "p_clipping+channel_skew";
  EXPECT_NE(Advice(clipped, true).find("range"), std::string::npos);
  // What tells a class apart comes first.
  clipped.effect = "p_clipping+delay_dispersion";
  clipped.indistinguishable = {"p_clipping+second_delay_path"};
  EXPECT_NE(Advice(clipped, true).find("three times the cycle"), std::string::npos);
}

}  // namespace
}  // namespace howl::advice_test
