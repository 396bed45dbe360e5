// Effects: nulls change nothing, and what is withheld is in the records.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "rig/constants.h"
#include "tests/rig/two_point_rig.h"

namespace rig::effects_test {
namespace {

TEST(Effects, AtTheirNullsAreTheBase) {
  const std::vector<std::pair<std::string, Parameters>> nulls = {
      {"q_sensor_lowpass", {{"cutoff_hz", kNever}}},
      {"flame_lowpass", {{"cutoff_hz", kNever}}},
      {"p_sensor_resonance", {{"f0_hz", kNever}}},
      {"channel_skew", {{"skew_s", 0.0}}},
      {"extra_acoustic_mode", {{"coeff_over_N", 0.0}}},
      {"mode_detuning", {{"ratio", 3.0}}},
      {"delay_dispersion", {{"sigma_s", 0.0}}},
      {"delay_varies_with_phi", {{"rel_span", 0.0}}},
      {"amplitude_dependent_delay", {{"rel_at_cycle", 0.0}}},
      {"nonlinear_damping", {{"xi_add_at_cycle", 0.0}}},
      {"parametric_noise", {{"rel_rms", 0.0}}},
      {"slow_drift", {{"rel_span", 0.0}}},
      {"intermittency", {{"gain_drop", 0.0}}},
      {"p_clipping", {{"fraction", kNever}}},
      {"q_clipping", {{"fraction", kNever}}},
      {"quantisation", {{"levels", kNever}}},
      {"mains_hum", {{"rel_p", 0.0}}},
      {"crosstalk_p_to_q", {{"rel", 0.0}}},
      {"second_delay_path", {{"share", 0.0}}},
      {"external_tone", {{"rel", 0.0}}},
      {"x_entropy_wave", {{"rel", 0.0}}},
      {"own_damping", {{"factor", 1.0}}},
      {"x_flame_resonance", {{"gain", 0.0}}},
      {"x_flame_play", {{"rel", 0.0}}},
      {"x_delay_wander", {{"rel_rms", 0.0}}},
      {"duct_noise", {{"rel", 0.0}}},
      {"x_swept_source", {{"rel", 0.0}}},
      {"p_sensor_highpass", {{"cutoff_hz", 0.0}}},
      {"p_dropouts", {{"per_s", 0.0}}},
      {"q_sensor_highpass", {{"cutoff_hz", 0.0}}},
      {"x_p_echo", {{"share", 0.0}}},
      {"x_q_clock", {{"rel", 0.0}}},
      {"x_q_compression", {{"rel", 0.0}}},
      {"x_point_wander", {{"rel_rms", 0.0}}},
      {"x_odd_point", {{"rel", 0.0}}}};
  ASSERT_EQ(nulls.size(), Effects().size());
  const std::string base = RecordCsv(Simulate(TwoPoints()));
  for (const auto& [id, parameters] : nulls) {
    EXPECT_TRUE(RecordCsv(Simulate(With(id, parameters))) == base) << id;
  }
}

TEST(Effects, ChangeTheRecords) {
  const std::string base = RecordCsv(Simulate(TwoPoints()));
  for (const EffectInfo& effect : Effects()) {
    Spec spec = TwoPoints();
    spec.effects.push_back({effect.id, 0.85, std::nullopt});
    // Which point is the odd one is drawn.
    EXPECT_TRUE(RecordCsv(Simulate(spec, 0)) != base ||
                RecordCsv(Simulate(spec, 1)) != RecordCsv(Simulate(TwoPoints(), 1)))
        << effect.id;
  }
}

TEST(Effects, CoverEveryBlockInsideAndOutsideTheCatalogue) {
  std::set<std::string> outside;
  int inside = 0;
  for (const EffectInfo& effect : Effects()) {
    EXPECT_EQ(effect.in_catalogue, !effect.id.starts_with("x_")) << effect.id;
    if (effect.in_catalogue) {
      ++inside;
    } else {
      outside.insert(effect.block);
    }
  }
  EXPECT_EQ(inside, 25);
  EXPECT_EQ(outside, (std::set<std::string>{"acoustics", "flame", "delay", "source", "p_instrument",
                                            "q_instrument", "operating_point"}));
}

TEST(Effects, SizesLieEvenlyInTheLogarithm) {
  const EffectInfo& effect = FindEffect("q_sensor_lowpass");
  EXPECT_DOUBLE_EQ(SizeAt(effect, 0.25), effect.small);
  EXPECT_DOUBLE_EQ(SizeAt(effect, 0.85), effect.large);
  EXPECT_NEAR(SizeAt(effect, 0.7), std::sqrt(effect.medium * effect.large), 1e-9);
  EXPECT_THROW(FindEffect("x_gremlin"), std::runtime_error);
}

double Largest(const std::vector<double>& x) {
  double largest = 0.0;
  for (const double value : x) largest = std::max(largest, std::abs(value));
  return largest;
}

TEST(Effects, ClippedSignalsStayBelowTheirLevel) {
  const Record base = Simulate(TwoPoints());
  const Record cut = Simulate(With("p_clipping", {{"fraction", 0.8}}));
  const double level = Largest(cut.p);
  EXPECT_LT(level, 0.9 * Largest(base.p));
  const auto at_level = std::ranges::count_if(
      cut.p, [&](double value) { return std::abs(value) > 0.999999 * level; });
  // A sinusoid is above 0.8 of its amplitude 41 % of the time.
  EXPECT_NEAR(static_cast<double>(at_level) / static_cast<double>(cut.p.size()), 0.41, 0.03);
  EXPECT_EQ(RecordCsv({base.p, cut.q}), RecordCsv(base));
}

TEST(Effects, QuantisedPressureHasFewLevels) {
  const Record record = Simulate(With("quantisation", {{"levels", 18.0}}));
  const std::set<double> levels(record.p.begin(), record.p.end());
  EXPECT_LE(levels.size(), 19u);
  EXPECT_GE(levels.size(), 15u);
}

TEST(Effects, HumHasItsAmplitudeAndFrequency) {
  const Record base = Simulate(TwoPoints());
  const Record hum = Simulate(With("mains_hum", {{"rel_q", 0.1}, {"hz", 50.0}}));
  double square = 0.0;
  for (const double value : base.q) square += value * value;
  const double amplitude = std::sqrt(2.0 * square / static_cast<double>(base.q.size()));
  Complex sum = 0.0;
  for (std::size_t n = 0; n < base.q.size(); ++n) {
    sum +=
        (hum.q[n] - base.q[n]) * std::polar(1.0, -kTwoPi * 50.0 * static_cast<double>(n) / 5000.0);
  }
  EXPECT_NEAR(2.0 * std::abs(sum) / static_cast<double>(base.q.size()) / amplitude, 0.1, 0.003);
}

TEST(Effects, SkewMovesOneChannelInTime) {
  Spec plain = TwoPoints();
  plain.sensor_noise = 0.0;
  Spec moved = plain;
  moved.effects.push_back({"channel_skew", 0.5, Parameters{{"skew_s", 4e-4}}});
  const Record a = Simulate(plain);
  const Record b = Simulate(moved);
  // Two samples of the record. The lead grows with the skew, so that the records' starts differ by
  // whole steps of the grid: p says by how many.
  double best = 1e9;
  for (int shift = -8; shift <= 8; ++shift) {
    double p_error = 0.0;
    double q_error = 0.0;
    for (std::size_t n = 100; n < 1500; ++n) {
      const std::ptrdiff_t m = static_cast<std::ptrdiff_t>(n) + shift;
      p_error += std::abs(a.p[m] - b.p[n]);
      q_error += std::abs(a.q[m - 2] - b.q[n]);
    }
    best = std::min(best, p_error / Largest(a.p) + q_error / Largest(a.q));
  }
  EXPECT_LT(best / 1400.0, 1e-3);
}

// As late or early at either end as half its rate times the record says.
TEST(Effects, AClockThatGainsSkewsMoreAndMore) {
  constexpr double kRate = 4e-4;
  Spec plain = TwoPoints();
  plain.sensor_noise = 0.0;
  Spec moved = plain;
  moved.effects.push_back({"x_q_clock", 0.5, Parameters{{"rel", kRate}}});
  const Record a = Simulate(plain);
  const Record b = Simulate(moved);
  EXPECT_EQ(RecordCsv({a.p, a.p}), RecordCsv({b.p, b.p}));
  const auto n = static_cast<std::ptrdiff_t>(a.q.size());
  for (const double at : {0.1, 0.5, 0.9}) {
    // The shift, in samples, that leaves least of the difference, to first order.
    double slopes = 0.0;
    double differences = 0.0;
    for (std::ptrdiff_t i = -150; i < 150; ++i) {
      const auto k = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at * n) + i);
      const double slope = 0.5 * (a.q[k + 1] - a.q[k - 1]);
      slopes += slope * slope;
      differences += slope * (a.q[k] - b.q[k]);
    }
    const double expected = kRate * (at - 0.5) * static_cast<double>(n);
    EXPECT_NEAR(differences / slopes, expected, 0.02 + 0.1 * std::abs(expected)) << at;
  }
}

TEST(Effects, AnEchoIsTheSignalOnceMore) {
  Spec plain = TwoPoints();
  plain.sensor_noise = 0.0;
  Spec moved = plain;
  moved.effects.push_back({"x_p_echo", 0.5, Parameters{{"share", 0.3}, {"delay_s", 2e-3}}});
  const Record a = Simulate(plain);
  const Record b = Simulate(moved);
  EXPECT_EQ(RecordCsv({a.q, a.q}), RecordCsv({b.q, b.q}));
  double worst = 0.0;
  for (std::size_t k = 100; k < a.p.size(); ++k) {
    worst = std::max(worst, std::abs(b.p[k] - a.p[k] - 0.3 * a.p[k - 10]));
  }
  EXPECT_LT(worst, 2e-3 * Largest(a.p));
}

TEST(Rig, IsTheSameForTheSameSeedAlone) {
  Spec spec = TwoPoints();
  spec.scatter = true;
  const auto key = [&](std::uint64_t seed) {
    spec.seed = seed;
    const Plan plan = MakePlan(spec);
    return KeyJson(spec, plan, MakeGrid(plan, spec.sampling_hz, 1));
  };
  EXPECT_EQ(key(3), key(3));
  EXPECT_NE(key(3), key(4));
  EXPECT_EQ(RecordCsv(Simulate(spec)), RecordCsv(Simulate(spec)));
}

// What is drawn for an effect moves nothing else.
TEST(Rig, DrawsTheSameRigWhateverIsWithheld) {
  Spec spec = TwoPoints();
  spec.scatter = true;
  const Plan base = MakePlan(spec);
  spec.effects.push_back({"mains_hum", 0.55, std::nullopt});
  const Plan hum = MakePlan(spec);
  EXPECT_EQ(base.points[1].modes.N, hum.points[1].modes.N);
  EXPECT_EQ(base.points[1].flame.slope, hum.points[1].flame.slope);
  EXPECT_EQ(base.sensor_noise, hum.sensor_noise);
}

TEST(Rig, ConfigSaysNothingOfTheEffect) {
  Spec spec = TwoPoints();
  const std::string plain = ConfigYaml(spec);
  spec.effects.push_back({"quantisation", 0.85, std::nullopt});
  EXPECT_EQ(ConfigYaml(spec), plain);
}

}  // namespace
}  // namespace rig::effects_test
