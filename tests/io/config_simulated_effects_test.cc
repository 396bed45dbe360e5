// simulate.effects: identifiers and parameters of the catalogue; a mistake suggests the nearest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/config/reading/config_reading.h"
#include "model/effects/catalogue.h"
#include "tests/io/config_file.h"

namespace howl::config_simulated_effects_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string WithEffect(const std::string& effect) {
  return "experiments:\n"
         "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}\n"
         "simulate:\n  effects:\n    - {effect: " +
         effect + "}\n";
}

SimulatedEffect Only(const std::string& effect) {
  const ConfigFile file(WithEffect(effect));
  const Config config = LoadConfig(file.Path());
  EXPECT_EQ(config.simulation.effects.size(), 1u);
  return config.simulation.effects.at(0);
}

TEST(ConfigSimulatedEffects, ParametersInTheirOrderNullsWhereAbsent) {
  const SimulatedEffect mode = Only("extra_acoustic_mode, zeta: 0.02, coeff_over_N: -0.2");
  EXPECT_EQ(mode.effect->id(), "extra_acoustic_mode");
  EXPECT_EQ(mode.values, (std::vector<double>{2.0, -0.2, 0.02}));
  EXPECT_EQ(mode.line, 5);
}

TEST(ConfigSimulatedEffects, EveryEffectAtItsNull) {
  for (const EffectPointer& effect : SimulationCatalogue()) {
    std::string text(effect->id());
    for (const EffectParameter& p : effect->parameters()) {
      text +=
          ", " + p.name + ": " + (std::isinf(p.null_value) ? ".inf" : std::to_string(p.null_value));
    }
    const EffectForm form = effect->form();
    if (!form.key.empty()) text += ", " + form.key + ": " + form.value;
    const SimulatedEffect read = Only(text);
    EXPECT_EQ(read.effect->id(), effect->id());
    EXPECT_EQ(read.effect->form().value, form.value);
    EXPECT_EQ(read.values, NullValues(*effect)) << text;
  }
}

TEST(ConfigSimulatedEffects, MistakesNameTheNearest) {
  const auto mistake = [](const std::string& effect) {
    return ConfigFile(WithEffect(effect)).Mistake();
  };
  EXPECT_THAT(mistake("q_sensor_lowpas, cutoff_hz: 245"),
              AllOf(HasSubstr(":5: simulate.effects[0].effect: "),
                    HasSubstr("expected the nearest one, q_sensor_lowpass")));
  EXPECT_THAT(mistake("q_sensor_lowpass, cutof_hz: 245"),
              AllOf(HasSubstr(":5: simulate.effects[0].cutof_hz: "),
                    HasSubstr("expected the nearest one, cutoff_hz")));
  EXPECT_THAT(mistake("q_sensor_lowpass, cutoff_hz: 245, order: 3"),
              AllOf(HasSubstr("simulate.effects[0].order: "), HasSubstr("1, 2")));
  EXPECT_THAT(
      mistake("q_sensor_lowpass, cutoff_hz: 245 Hz"),
      AllOf(HasSubstr("simulate.effects[0].cutoff_hz: "), HasSubstr("expected a number in Hz")));
  EXPECT_THAT(mistake("channel_skew, skew_s: 0.4"),
              AllOf(HasSubstr("simulate.effects[0].skew_s: 0.4 is out of range"),
                    HasSubstr("0 for no effect")));
  EXPECT_THAT(mistake("channel_skew"),
              AllOf(HasSubstr("simulate.effects[0].skew_s: is missing"), HasSubstr("expected")));
  EXPECT_THAT(
      ConfigFile("experiments:\n"
                 "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: 0, gain: 1}\n"
                 "simulate: {effects: [{cutoff_hz: 3}]}\n")
          .Mistake(),
      AllOf(HasSubstr(":3: simulate.effects[0].effect: is missing"), HasSubstr("expected")));
}

}  // namespace
}  // namespace howl::config_simulated_effects_test
