// A candidate whose parameter stands where its search ends says so.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "diagnosis/candidates/attempt.h"
#include "diagnosis/diagnosis.h"
#include "tests/diagnosis/declare.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::at_bound_test {
namespace {

// A first-order low-pass on recorded q that is searched from low_hz on.
EffectPointer LowPassFrom(double low_hz) {
  return std::make_shared<DeclaredEffect>(Declare("cable", LoopPlace::kHeatReleaseRecorded,
                                                  DeclaredForm::kTransfer,
                                                  "1 / (1 + s / (2 * pi * cutoff_hz))",
                                                  {"cutoff_hz",
                                                   "Hz",
                                                   std::numeric_limits<double>::infinity(),
                                                   low_hz,
                                                   1e6,
                                                   {1.5 * low_hz, 4.0 * low_hz},
                                                   ParameterScale::kLogarithmic}));
}

TEST(LongAtBound, ACandidateSaysThatItsSearchEndsThere) {
  constexpr double kTrueHz = 400.0;
  const std::vector<DiagnosisExperiment> rig =
      SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, kTrueHz)});
  for (const double low_hz : {0.25 * kTrueHz, 1.5 * kTrueHz}) {
    DiagnosisOptions options;
    options.withheld = AllBut({});
    options.further = {LowPassFrom(low_hz)};
    const Diagnosis diagnosis = Diagnose(rig, options);
    const auto found = std::ranges::find(diagnosis.candidates, "cable", &Candidate::effect);
    ASSERT_NE(found, diagnosis.candidates.end());
    ASSERT_EQ(found->parameters.size(), 1U);
    const EstimatedParameter& cutoff = found->parameters[0];
    EXPECT_EQ(cutoff.at_bound, low_hz > kTrueHz) << low_hz;
    EXPECT_NEAR(cutoff.value, std::max(low_hz, kTrueHz), 0.05 * kTrueHz);
  }
}

TEST(AtBound, TheEndsOfTheSearchAreItsBoundsInTheParametersOwnScale) {
  const EffectParameter width{"width", "", 0.0, -2.0, 6.0, {1.0}, ParameterScale::kLinear};
  EXPECT_TRUE(StandsAtBound(width, -2.0));
  EXPECT_TRUE(StandsAtBound(width, 6.0));
  EXPECT_FALSE(StandsAtBound(width, 5.9));
  const EffectParameter cutoff{"cutoff", "Hz", 1e6, 1e-3, 1e6, {1.0}, ParameterScale::kLogarithmic};
  EXPECT_TRUE(StandsAtBound(cutoff, 1e-3));
  // Near on the linear scale, a factor of two away on its own.
  EXPECT_FALSE(StandsAtBound(cutoff, 2e-3));
}

}  // namespace
}  // namespace howl::at_bound_test
