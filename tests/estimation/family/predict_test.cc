#include "estimation/family/answers/predict/predict.h"

#include <gtest/gtest.h>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/family/answers/predict/advise.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/sample.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

namespace howl::predict_test {
namespace {

// The paper's nominal model: omega = 2 pi 215, xi = 0.2, tau = 3.46 ms, N = 6609, M / N = 0.415
// puts the second crossing near 750 Hz with a gain of 0.87 (reading notes, item 9).
TEST(PredictTest, SecondCrossingOfTheNominalModel) {
  const LoopModel model{215.0, 0.2, 6609.0, 0.415 * 6609.0, 3.46e-3, 3.0};
  const std::optional<double> line = CrossingNear(model, {600.0, 900.0});
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(*line, 750.0, 10.0);
  EXPECT_NEAR(double(reference::Deg(-reference::L(reference::From(model), *line))), 0.0, 1e-6);
  const std::optional<double> gain = LineGain(model, {600.0, 900.0}, -0.703e-4);
  ASSERT_TRUE(gain.has_value());
  EXPECT_NEAR(*gain, 0.87, 0.01);
  EXPECT_FALSE(CrossingNear(model, {760.0, 780.0}).has_value());
}

TEST(PredictTest, InterpolationIsLinearBetweenNeighbours) {
  const std::vector<Experiment> experiments = R228();
  Member member;
  for (int i = 0; i < 6; ++i) member.push_back({200.0 + i, 0.3 - 0.01 * i, 1e3, 0, 3e-3, 3.0});
  const auto half = InterpolateModel(experiments, member, 0.52);  // exp2 at 0.53, exp3 at 0.51
  ASSERT_TRUE(half.has_value());
  EXPECT_NEAR(half->omega_hz, 201.5, 1e-9);
  EXPECT_NEAR(half->xi, 0.285, 1e-12);
  EXPECT_NEAR(InterpolateModel(experiments, member, 0.49)->omega_hz, 203.0, 1e-9);
  EXPECT_FALSE(InterpolateModel(experiments, member, 0.57).has_value());
  EXPECT_FALSE(InterpolateModel(experiments, member, 0.44).has_value());
}

// Leave one out: experiments 1, 3, 5 predict the limit cycle of 2 and 4.
TEST(PredictTest, FrequencyAtAnExperimentLeftOut) {
  const std::vector<Experiment> all = R228();
  FamilyProblem problem{.experiments = {all[0], all[2], all[4]}};
  const MemberSample sample = SampleMembers(problem, {.count = 400, .seed = 3});
  for (const std::size_t left_out : {1u, 3u}) {
    const Prediction prediction =
        PredictSampled("frequency", sample.members, [&](std::span<const LoopModel> models) {
          return InterpolatedFrequency(problem.experiments, models, all[left_out].phi);
        });
    EXPECT_EQ(prediction.kind, IntervalKind::kSampled);
    EXPECT_EQ(prediction.members, sample.members.size());
    EXPECT_LT(prediction.interval.lo, prediction.interval.hi);
    EXPECT_NEAR(0.5 * (prediction.central_90.lo + prediction.central_90.hi),
                all[left_out].frequency_hz, 0.03 * all[left_out].frequency_hz);
  }
}

TEST(AdviseTest, FurtherExperimentsFalsifyWhatTheyShould) {
  const std::vector<Experiment> all = R228();
  FamilyProblem problem{.experiments = R228Reliable()};
  const MemberSample sample = SampleMembers(problem, {.count = 300, .seed = 3});
  // The same experiments again: all survive. One far off in gain: none does, and gain says so.
  EXPECT_EQ(TestFurther(problem, sample.members, problem.experiments).counts.survive, 300u);
  Experiment other = all[1];
  other.gain *= 1.5;
  const SurvivalResult none = TestFurther(problem, sample.members, std::span(&other, 1));
  EXPECT_EQ(none.counts.rejected, 300u);
  EXPECT_EQ(none.counts.rejected_by[static_cast<std::size_t>(Condition::kGain)], 300u);
  // Outside the measured phi nothing is tested.
  EXPECT_EQ(TestFurther(problem, sample.members, std::span(&all[5], 1)).counts.untested, 300u);
}

// A cubic flame has the describing function k (1 - a^2 / 9), a = A |k| / Q up to 3 / 2: the cycle
// has a = 3 sqrt(1 - 1 / loop gain), and p the amplitude A / w, a lightly damped loop passing
// little of the harmonics.
TEST(PressureAmplitudeTest, CubicFlameAgainstItsDescribingFunction) {
  const Experiment e = R228()[0];
  const double xi = 0.02, w = 2 * M_PI * e.frequency_hz;
  LoopModel model = ClosedFormMember(e, xi);
  for (const double loop_gain : {1.05, 1.2, 1.3}) {
    const double slope = -loop_gain / (e.gain * w);
    const Flame<double> flame{FlameShape::kCubic, slope, 0.7, 0.0};
    const double expected = 3.0 * std::sqrt(1.0 - 1.0 / loop_gain) * 0.7 / std::abs(slope) / w;
    const auto amplitude = PressureAmplitude(model, flame, e.frequency_hz);
    ASSERT_TRUE(amplitude.has_value()) << loop_gain;
    EXPECT_NEAR(*amplitude, expected, 2e-3 * expected) << loop_gain;
  }
  const Flame<double> weak{FlameShape::kCubic, -0.9 / (e.gain * w), 0.7, 0.0};
  EXPECT_FALSE(PressureAmplitude(model, weak, e.frequency_hz).has_value());
}

TEST(PredictSampledTest, TheThreadsDoNotMatter) {
  const FamilyProblem problem{.experiments = R228()};
  const std::vector<Member> members = EnumerateMembers(problem, 200, 1, 1).members;
  const auto predictor = [](std::span<const LoopModel> m) -> std::optional<double> {
    if (m[0].xi < 0.1) return std::nullopt;
    return m[0].xi * m[5].N;
  };
  const Prediction one = PredictSampled("x", members, predictor, 1);
  const Prediction four = PredictSampled("x", members, predictor, 4);
  EXPECT_LT(one.members, members.size());
  EXPECT_EQ(one.members, four.members);
  EXPECT_EQ(one.interval.lo, four.interval.lo);
  EXPECT_EQ(one.interval.hi, four.interval.hi);
  EXPECT_EQ(one.central_90.lo, four.central_90.lo);
  EXPECT_EQ(one.central_90.hi, four.central_90.hi);
}

// Truth by hand: predictions uniform on [0, 1] with std s << 1 leave about 4 s of the family inside
// (a band of +-2 s, its chance profile integrates to 4 s), less at the two ends.
TEST(AdviseTest, ExpectedRemainingOfAUniformPrediction) {
  std::vector<Member> members;
  for (int k = 0; k < 2000; ++k) members.push_back({{(k + 0.5) / 2000.0, 0, 0, 0, 0, 3}});
  const auto omega = [](std::span<const LoopModel> m) -> std::optional<double> {
    return m[0].omega_hz;
  };
  const double s = 0.01;
  const std::vector<Measurement> measurements = {
      {"useless", "", 1e6, omega},
      {"constant", "", 1.0,
       [](std::span<const LoopModel>) -> std::optional<double> { return 1.0; }},
      {"sharp", "", s, omega}};
  const std::vector<Advice> advice = Advise(members, measurements);
  ASSERT_EQ(advice.size(), 3u);
  EXPECT_EQ(advice[0].name, "sharp");
  EXPECT_NEAR(advice[0].expected_remaining, 4 * s, 0.1 * 4 * s);
  // What cannot tell members apart leaves those within two standard deviations of its own error.
  EXPECT_NEAR(advice[1].expected_remaining, 0.9545, 1e-3);
  EXPECT_NEAR(advice[2].expected_remaining, 0.9545, 1e-3);
}

// A transfer at a second frequency tells xi apart, which the limit cycle alone cannot.
TEST(AdviseTest, SecondFrequencyBeatsAnotherPhi) {
  FamilyProblem problem{.experiments = R228()};
  const MemberSample sample = SampleMembers(problem, {.count = 500, .seed = 3});
  const std::vector<Advice> advice =
      Advise(sample.members, DefaultMeasurements(problem.experiments, 3.0));
  ASSERT_GT(advice.size(), 20u);
  EXPECT_NE(advice[0].name.find("q-to-p"), std::string::npos) << advice[0].name;
  EXPECT_NE(advice[0].name.find("Hz"), std::string::npos) << advice[0].name;
  EXPECT_LT(advice[0].expected_remaining, 0.2);
  for (std::size_t k = 1; k < advice.size(); ++k) {
    EXPECT_GE(advice[k].expected_remaining, advice[k - 1].expected_remaining);
  }
}

}  // namespace
}  // namespace howl::predict_test
