// Mistakes in a rig's file are one line that says where.
#include "rig/spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace rig::spec_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class SpecFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string form = (std::filesystem::temp_directory_path() / "howl_rig_XXXXXX").string();
    ASSERT_NE(mkdtemp(form.data()), nullptr);
    folder_ = form;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Spec Load(const std::string& text) const {
    const std::string path = folder_ / "rig.yaml";
    std::ofstream(path) << text;
    return LoadSpec(path);
  }
  std::string Mistake(const std::string& text) const {
    try {
      Load(text);
    } catch (const SpecError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path folder_;
};

constexpr const char* kOne = "experiments:\n  - {name: a, frequency_hz: 200}\n";

TEST_F(SpecFile, HasDefaults) {
  const Spec spec = Load(kOne);
  EXPECT_EQ(spec.experiments.size(), 1u);
  EXPECT_EQ(spec.duration_s, 3.2);
  EXPECT_EQ(spec.sampling_hz, 5000.0);
  EXPECT_TRUE(spec.effects.empty());
  EXPECT_FALSE(spec.combustion_noise.has_value());
}

TEST_F(SpecFile, ReadsEffects) {
  const Spec spec = Load(std::string(kOne) +
                         "effects:\n"
                         "  - {id: channel_skew, severity: large}\n"
                         "  - {id: quantisation, severity: 0.4}\n"
                         "  - {id: p_clipping, parameters: {fraction: 0.9}}\n"
                         "flame: erf\nnoise: {sensor_relative: 0.01}\n");
  ASSERT_EQ(spec.effects.size(), 3u);
  EXPECT_EQ(spec.effects[0].severity, 0.85);
  EXPECT_EQ(spec.effects[1].severity, 0.4);
  EXPECT_EQ(spec.effects[2].parameters->at("fraction"), 0.9);
  EXPECT_EQ(spec.flame, FlameShape::kErf);
  EXPECT_EQ(spec.sensor_noise, 0.01);
}

TEST_F(SpecFile, NamesTheMistakesPlace) {
  const std::string one = kOne;
  EXPECT_THAT(Mistake("experiments:\n  - {name: a, frequency_hz: 200, gian: 3}\n"),
              HasSubstr("rig.yaml:2: gian: is not a known key of experiments"));
  EXPECT_THAT(Mistake("experiments:\n  - {name: a}\n"), EndsWith(":2: frequency_hz: is missing"));
  EXPECT_THAT(Mistake("seed: 1\n"), HasSubstr("experiments: expected a list"));
  EXPECT_THAT(Mistake(one + "effects: 3\n"), EndsWith(":3: effects: expected a list of effects"));
  EXPECT_THAT(Mistake(one + "effects: [{id: x_gremlin}]\n"), HasSubstr(":3: id: x_gremlin is no"));
  EXPECT_THAT(Mistake(one + "effects: [{id: p_clipping, parameters: {levels: 3}}]\n"),
              EndsWith("levels is no parameter of p_clipping, expected fraction"));
  EXPECT_THAT(Mistake(one + "duration_s: nan\n"), HasSubstr(":3: duration_s: expected a number"));
  EXPECT_THAT(Mistake(one + "flame: blue\n"), HasSubstr(":3: flame: expected any, tanh"));
  EXPECT_THAT(Mistake(one + "  - {name: a, frequency_hz: 210}\n"), EndsWith("a is there twice"));
  EXPECT_THAT(Mistake("experiments: [\n"), HasSubstr("rig.yaml:2: "));
}

}  // namespace
}  // namespace rig::spec_test
