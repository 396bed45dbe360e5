// Effects in a config: what a good declaration reads as, and what is said of a bad one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/config/reading/config_reading.h"
#include "tests/io/config_file.h"

namespace howl::config_effects_test {
namespace {

const std::string kExperiments =
    "experiments:\n  - {name: a, phi: 1, frequency_hz: 200, phase_deg: 1, gain: 1}\n";

// The effects start on line 3.
std::string Mistake(const std::string& effect) {
  const std::string text = ConfigFile(kExperiments + "effects:\n" + effect).Mistake();
  const std::size_t at = text.find("config.yaml:");
  return at == std::string::npos ? text : text.substr(at + 12);
}

TEST(ConfigEffects, FiveLinesDeclareAResonance) {
  const ConfigFile file(kExperiments +
                        "effects:\n"
                        "  - name: horn_resonance\n"
                        "    at: p_recorded\n"
                        "    transfer: 1 / (1 + 2*zeta*s/(2*pi*f0_hz) + (s/(2*pi*f0_hz))^2)\n"
                        "    parameters:\n"
                        "      f0_hz: {null_value: inf, low: 300, high: 2000, starts: [500, 900]}\n"
                        "      zeta: {null_value: 0.2, low: 0.01, high: 2}\n");
  const Config config = LoadConfig(file.Path());
  ASSERT_EQ(config.effects.size(), 1u);
  const EffectDeclaration& effect = config.effects[0];
  EXPECT_EQ(effect.name, "horn_resonance");
  EXPECT_EQ(effect.place, LoopPlace::kPressureRecorded);
  ASSERT_EQ(effect.parameters.size(), 2u);
  EXPECT_TRUE(std::isinf(effect.parameters[0].null_value));
  EXPECT_EQ(effect.parameters[0].scale, ParameterScale::kLogarithmic);
  EXPECT_EQ(effect.parameters[0].starts, (std::vector<double>{500.0, 900.0}));
  EXPECT_EQ(effect.parameters[1].scale, ParameterScale::kLinear);
  EXPECT_EQ(effect.parameters[1].starts.size(), 2u);
}

TEST(ConfigEffects, PolynomialsHaveTheHighestPowerFirst) {
  const ConfigFile file(kExperiments +
                        "effects:\n"
                        "  - name: coupling\n"
                        "    at: q_recorded\n"
                        "    transfer: {numerator: [1, 0], denominator: [1, 2*pi*corner_hz]}\n"
                        "    parameters: {corner_hz: {null_value: 0, low: 1, high: 100}}\n");
  const Config config = LoadConfig(file.Path());
  ASSERT_EQ(config.effects.size(), 1u);
  const DeclaredEffect effect(config.effects[0]);
  const Response s = LaplaceVariable(50.0);
  const Response expected = s / (s + kRadPerSPerHz * 30.0);
  EXPECT_LT(std::abs(effect.HeatReleaseInstrument(50.0, std::vector<double>{30.0}) - expected),
            1e-15);
}

TEST(ConfigEffects, LinesAndMaps) {
  const ConfigFile file(
      kExperiments +
      "effects:\n"
      "  - {name: fan, at: source, line_hz: [85, 90]}\n"
      "  - name: bends\n"
      "    at: q_recorded\n"
      "    static_map: limit * x / (limit + abs(x))\n"
      "    parameters: {limit: {null_value: 1e300, low: 1, high: 10, scale: logarithmic}}\n");
  const Config config = LoadConfig(file.Path());
  ASSERT_EQ(config.effects.size(), 2u);
  EXPECT_EQ(config.effects[0].form, DeclaredForm::kLine);
  EXPECT_EQ(config.effects[0].line_high_hz, 90.0);
  EXPECT_NEAR(DeclaredEffect(config.effects[1]).Map(2.0, std::vector<double>{4.0}), 8.0 / 6.0,
              1e-15);
}

struct BadEffect {
  const char* yaml;
  const char* message;
};

const std::string kCorner = "    parameters: {corner_hz: {null_value: inf, low: 10, high: 900}}\n";

TEST(ConfigEffects, MistakesAreNamedByLineAndKey) {
  const auto body = [](const std::string& at, const std::string& what) {
    return "  - name: mine\n    at: " + at + "\n    " + what + "\n" + kCorner;
  };
  EXPECT_EQ(Mistake(body("q_recorded", "transfer: 2 / (1 + s/(2*pi*corner_hz))")),
            "6: effects[0].transfer: with its parameters at null_value it is 1 away from the loop "
            "without it at 1 Hz, expected 1 to within 1e-12");
  EXPECT_EQ(Mistake(body("q_recorded", "transfer: 1 / (1 + s/(2*pi*corner_khz))")),
            "6: effects[0].transfer: at character 18: unknown name corner_khz, expected s, f_hz, "
            "j, corner_hz, pi or a function; the nearest is corner_hz");
  EXPECT_EQ(Mistake(body("q_recoded", "transfer: 1")),
            "5: effects[0].at: \"q_recoded\" is not known here, expected one of acoustics, "
            "flame_in, delay, flame_out, source, p_recorded, q_recorded; the nearest is "
            "q_recorded");
  EXPECT_THAT(Mistake(body("q_recorded", "transfr: 1")),
              testing::StartsWith("6: effects[0].transfr: is not a known key, expected the nearest "
                                  "one, transfer"));
  EXPECT_EQ(Mistake(body("flame_in", "static_map: x / corner_hz")),
            "6: effects[0].static_map: cannot be at flame_in: inside the loop the flame's free "
            "characteristic absorbs it, expected at: p_recorded or q_recorded");
  EXPECT_EQ(Mistake(body("source", "transfer: 1 / corner_hz")),
            "6: effects[0].transfer: cannot be at source, expected line_hz there, or another "
            "place");
  EXPECT_EQ(Mistake(body("q_recorded", "transfer: 1 / (1 + s/1000)")),
            "7: effects[0].parameters.corner_hz: is not in the formula, expected it in transfer");
  EXPECT_EQ(Mistake(body("q_recorded", "delay_factor: corner_hz")),
            "6: effects[0].delay_factor: acts on the loop's delay, expected at: delay");
  EXPECT_EQ(Mistake(body("q_recorded", "transfer: 1 + (s")),
            "6: effects[0].transfer: at character 7: expected ')'");
  EXPECT_THAT(Mistake("  - {name: mine, at: source}\n"),
              testing::StartsWith("4: effects[0]: says nothing of what the effect does"));
  EXPECT_THAT(Mistake("  - {name: mains_hum, at: source, line_hz: [1, 2]}\n"),
              testing::StartsWith("4: effects[0].name: \"mains_hum\" is an effect of the "
                                  "catalogue"));
  EXPECT_THAT(Mistake("  - {name: mine, at: source, line_hz: [90, 85]}\n"),
              testing::StartsWith("4: effects[0].line_hz[1]: 85 is not above the first"));
  EXPECT_THAT(Mistake("  - {name: fan, at: source, line_hz: [80, 85]}\n"
                      "  - {name: fan, at: source, line_hz: [90, 95]}\n"),
              testing::StartsWith("5: effects[1].name: \"fan\" is taken by the effect on line 4"));
}

TEST(ConfigEffects, MistakesInParameters) {
  const auto with = [](const std::string& parameter) {
    return Mistake(
        "  - name: mine\n    at: q_recorded\n    transfer: 1/(1+s/w)\n    parameters:\n"
        "      " +
        parameter + "\n");
  };
  EXPECT_EQ(with("w: {null_value: inf, low: 10, high: 5}"),
            "8: effects[0].parameters.w.high: 5 is not above low, expected low < high");
  EXPECT_EQ(with("w: {null_value: big, low: 10, high: 50}"),
            "8: effects[0].parameters.w.null_value: \"big\" is text, expected a number or inf");
  EXPECT_THAT(with("w: {null_valu: inf, low: 10, high: 50}"),
              testing::StartsWith("8: effects[0].parameters.w.null_valu: is not a known key, "
                                  "expected the nearest one, null_value"));
  EXPECT_EQ(with("w: {low: 10, high: 50}"),
            "8: effects[0].parameters.w.null_value: is missing, expected text or a number (value "
            "at which the effect is absent, a number or inf)");
  EXPECT_EQ(with("w: {null_value: inf, low: 10, high: 50, starts: [60]}"),
            "8: effects[0].parameters.w.starts[0]: 60 is outside the bounds, expected a start "
            "from low to high");
  EXPECT_EQ(with("s: {null_value: inf, low: 10, high: 50}"),
            "8: effects[0].parameters.s: already means something else in formulas, expected "
            "another name");
  EXPECT_EQ(with("w: {null_value: 0, low: 10, high: 50}"),
            "6: effects[0].transfer: with its parameters at null_value it is 1 away from the loop "
            "without it at 1 Hz, expected 1 to within 1e-12");
  EXPECT_EQ(with("w: {null_value: -inf, low: 10, high: 50, scale: linear}"), "");
}

}  // namespace
}  // namespace howl::config_effects_test
