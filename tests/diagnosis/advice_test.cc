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

TEST(Advice, ChangedSamplesCallForOthers) {
  Diagnosis changed = Named(3000.0);
  for (const char* effect : {"p_clipping", "q_clipping", "quantisation", "mains_hum+q_clipping"}) {
    changed.effect = effect;
    EXPECT_EQ(Advice(changed, true), kRecordAgain) << effect;
  }
  // What tells a class apart comes first.
  changed.effect = "q_clipping";
  changed.indistinguishable = {"second_delay_path", "delay_dispersion"};
  EXPECT_NE(Advice(changed, true).find("three times the cycle"), std::string::npos);
}

}  // namespace
}  // namespace howl::advice_test
