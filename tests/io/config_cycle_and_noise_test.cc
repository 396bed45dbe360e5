// cycle_hz, which picks the cycle of a record, and simulate.noise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "io/config/reading/config_reading.h"
#include "tests/io/config_file.h"

namespace howl::config_cycle_and_noise_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string TwoRecords(const std::string& top, const std::string& own) {
  return top +
         "experiments:\n"
         "  - {name: a, phi: 0.56, record: {file: a.csv, sampling_hz: 5000}" +
         own +
         "}\n"
         "  - {name: b, phi: 0.53, record: {file: b.csv, sampling_hz: 5000}}\n";
}

// A config with both records beside it, which need not hold anything to be named.
class WithRecords : public ConfigFile {
 public:
  WithRecords(const std::string& top, const std::string& own) : ConfigFile(TwoRecords(top, own)) {
    Write("a.csv", "");
    Write("b.csv", "");
  }
};

TEST(ConfigCycleBand, AnExperimentsOwnGoesBeforeTheCommonOne) {
  const WithRecords file("cycle_hz: [200, 400]\n", ", cycle_hz: [90, 130.5]");
  const Config config = LoadConfig(file.Path());
  ASSERT_TRUE(config.experiments[0].cycle_hz && config.experiments[1].cycle_hz);
  EXPECT_EQ(config.experiments[0].cycle_hz->low_hz, 90.0);
  EXPECT_EQ(config.experiments[0].cycle_hz->high_hz, 130.5);
  EXPECT_EQ(config.experiments[1].cycle_hz->low_hz, 200.0);
  EXPECT_EQ(config.experiments[1].cycle_hz->high_hz, 400.0);
}

TEST(ConfigCycleBand, NoneIsNone) {
  const Config config = LoadConfig(WithRecords("", "").Path());
  EXPECT_FALSE(config.experiments[0].cycle_hz);
}

TEST(ConfigCycleBand, Mistakes) {
  EXPECT_THAT(WithRecords("cycle_hz: [400, 200]\n", "").Mistake(),
              AllOf(HasSubstr(":1: cycle_hz"), HasSubstr("expected [low, high] in Hz")));
  EXPECT_THAT(WithRecords("", ", cycle_hz: [90, 90]").Mistake(),
              AllOf(HasSubstr(":2: "), HasSubstr("cycle_hz"), HasSubstr("not above the first")));
  EXPECT_THAT(WithRecords("", ", cycle_hz: 90").Mistake(), HasSubstr("cycle_hz"));
  EXPECT_THAT(ConfigFile("experiments:\n"
                         "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: "
                         "12.14, cycle_hz: [200, 240]}\n")
                  .Mistake(),
              AllOf(HasSubstr("cycle_hz"), HasSubstr("expected a record")));
}

std::string WithNoise(const std::string& noise) {
  return "experiments:\n"
         "  - {name: a, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14}\n"
         "simulate:\n  noise:\n    - {" +
         noise + "}\n";
}

SimulatedNoise Only(const std::string& noise) {
  const Config config = LoadConfig(ConfigFile(WithNoise(noise)).Path());
  EXPECT_EQ(config.simulation.noise.size(), 1U);
  return config.simulation.noise.at(0);
}

TEST(ConfigNoise, SourcesAndSpectra) {
  const SimulatedNoise duct = Only("source: duct, rms_relative: 0.1, corner_hz: 300");
  EXPECT_EQ(duct.place, NoisePlace::kDuct);
  EXPECT_EQ(duct.rms_relative, 0.1);
  EXPECT_EQ(duct.spectrum.colour, NoiseColour::kLowPass);
  EXPECT_EQ(duct.spectrum.frequency_hz, 300.0);
  const SimulatedNoise peak = Only("source: combustion, rms_relative: 0.1, peak_hz: 140");
  EXPECT_EQ(peak.spectrum.colour, NoiseColour::kResonance);
  EXPECT_EQ(peak.spectrum.damping, 0.1);
  const SimulatedNoise white = Only("source: background, rms_relative: 0");
  EXPECT_EQ(white.place, NoisePlace::kBackground);
  EXPECT_EQ(white.spectrum.colour, NoiseColour::kWhite);
}

TEST(ConfigNoise, Mistakes) {
  const auto mistake = [](const std::string& noise) {
    return ConfigFile(WithNoise(noise)).Mistake();
  };
  EXPECT_THAT(mistake("source: ducts, rms_relative: 0.1"), HasSubstr("duct"));
  EXPECT_THAT(mistake("source: duct, rms_relative: 0.1"),
              AllOf(HasSubstr(":5: simulate.noise[0].corner_hz: is missing"),
                    HasSubstr("noise inside the loop has a band")));
  EXPECT_THAT(mistake("source: duct, rms_relative: 0.1, corner_hz: 3, peak_hz: 4"),
              HasSubstr("expected only one of the two"));
  EXPECT_THAT(mistake("source: background, rms_relative: 0.1, damping: 0.2"),
              HasSubstr("expected peak_hz too"));
  EXPECT_THAT(mistake("source: background, rms_relative: 0.1, peak_hz: 50, damping: 1"),
              HasSubstr("damping"));
  EXPECT_THAT(mistake("source: background"), HasSubstr("rms_relative"));
}

}  // namespace
}  // namespace howl::config_cycle_and_noise_test
