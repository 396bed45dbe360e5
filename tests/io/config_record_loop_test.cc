// The config's `model` where it states more than the paper's loop.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "estimation/joint_records/loop_names.h"
#include "io/config/reading/config_reading.h"
#include "tests/io/config_file.h"

namespace howl::config_record_loop_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kExperiments =
    "experiments:\n  - {name: a, phi: 1, frequency_hz: 200, phase_deg: 1, gain: 1}\n";

Config Read(const std::string& model, LoopsTaken loops = LoopsTaken::kAny) {
  const ConfigFile file(kExperiments + ("model: {" + model + "}\n"));
  return LoadConfig(file.Path(), loops);
}

std::string Mistake(const std::string& model, LoopsTaken loops = LoopsTaken::kAny) {
  try {
    Read(model, loops);
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

// What howl diagnose advises can be taken as it stands.
TEST(ConfigRecordLoop, ReadsTheModelLineOfALoop) {
  PointStructure structure;
  structure.modes = 3;
  structure.delay_spread = DelaySpread::kNormal;
  for (const FlameInput input :
       {FlameInput::kPressureRate, FlameInput::kPressure, FlameInput::kVelocity}) {
    const std::string line = ModelLine(structure, input);
    ASSERT_EQ(line.rfind("model: {", 0), 0u);
    const RecordLoopSpec spec = *Read(line.substr(8, line.size() - 9)).record_loop;
    EXPECT_EQ(spec.flame_input, input);
    EXPECT_EQ(spec.modes, 3);
    EXPECT_FALSE(spec.ratio);
    EXPECT_TRUE(spec.own_damping);
    EXPECT_TRUE(spec.complex_residues);
    EXPECT_EQ(spec.delay_spread, DelaySpread::kNormal);
  }
  structure = {};
  structure.modes = 2;
  structure.ratio = 3.0;
  structure.own_damping = structure.complex_residues = false;
  structure.delay_spread = DelaySpread::kGamma;
  structure.second_path = true;
  const std::string line = ModelLine(structure, FlameInput::kPressureRate);
  const RecordLoopSpec spec = *Read(line.substr(8, line.size() - 9)).record_loop;
  EXPECT_EQ(spec.ratio, 3.0);
  EXPECT_FALSE(spec.own_damping);
  EXPECT_FALSE(spec.complex_residues);
  EXPECT_EQ(spec.delay_spread, DelaySpread::kGamma);
  EXPECT_TRUE(spec.second_path);
  // Beside one that is not tied to the others all are free.
  structure.modes = 3;
  structure.further_modes = 1;
  const std::string free = ModelLine(structure, FlameInput::kPressureRate);
  const RecordLoopSpec of_free = *Read(free.substr(8, free.size() - 9)).record_loop;
  EXPECT_EQ(of_free.modes, 3);
  EXPECT_FALSE(of_free.ratio);
  EXPECT_TRUE(of_free.own_damping);
}

TEST(ConfigRecordLoop, ThePapersLoopIsNoOther) {
  for (const std::string model :
       {"modes: 1", "modes: 2", "modes: 2, harmonic_ratio: 2.8", "modes: 2, ratio: 2.8",
        "modes: 2, damping: shared, residue: real, flame_input: pressure_rate",
        "modes: 1, delay_spread: none, delay_paths: 1, line_errors: true"}) {
    EXPECT_FALSE(Read(model, LoopsTaken::kPapers).record_loop) << model;
  }
  EXPECT_EQ(Read("modes: 2, ratio: 2.8").model.harmonic_ratio, 2.8);
  EXPECT_EQ(Read("modes: 2, ratio: 2.8").model.modes, 2);
}

TEST(ConfigRecordLoop, EachKeyStatesARicherLoop) {
  const RecordLoopSpec three = *Read("modes: 3").record_loop;
  EXPECT_EQ(three.modes, 3);
  EXPECT_EQ(three.ratio, 3.0);
  EXPECT_FALSE(three.own_damping);
  EXPECT_FALSE(three.complex_residues);
  EXPECT_EQ(three.flame_input, FlameInput::kPressureRate);
  EXPECT_TRUE(Read("modes: auto").record_loop->choose_modes);
  EXPECT_TRUE(Read("flame_input: auto").record_loop->choose_flame_input);
  EXPECT_FALSE(Read("modes: 2, ratio: free").record_loop->ratio);
  EXPECT_TRUE(Read("damping: own").record_loop->own_damping);
  EXPECT_TRUE(Read("residue: complex").record_loop->complex_residues);
  EXPECT_EQ(Read("flame_input: velocity").record_loop->flame_input, FlameInput::kVelocity);
  EXPECT_EQ(Read("flame_input: pressure").record_loop->flame_input, FlameInput::kPressure);
  EXPECT_EQ(Read("delay_spread: gamma").record_loop->delay_spread, DelaySpread::kGamma);
  EXPECT_EQ(Read("delay_spread: normal").record_loop->delay_spread, DelaySpread::kNormal);
  EXPECT_TRUE(Read("delay_paths: 2").record_loop->second_path);
  EXPECT_TRUE(three.line_errors);
  EXPECT_FALSE(Read("modes: 3, line_errors: false").record_loop->line_errors);
  // What else reads the config takes two modes at most.
  EXPECT_EQ(Read("modes: 5").model.modes, 2);
}

TEST(ConfigRecordLoop, SaysWhatIsWrong) {
  EXPECT_THAT(Mistake("modes: 9"), HasSubstr(":3: model.modes: 9 is out of range"));
  EXPECT_THAT(Mistake("modes: many"),
              HasSubstr(":3: model.modes: is \"many\", expected a number from 1 to 8, or auto"));
  EXPECT_THAT(Mistake("ratio: fixed"), HasSubstr("expected a number above 1, or free"));
  EXPECT_THAT(Mistake("ratio: 0.5"), HasSubstr(":3: model.ratio: 0.5 is out of range"));
  EXPECT_THAT(Mistake("ratio: 3, harmonic_ratio: 3"), HasSubstr("only one of the two"));
  EXPECT_THAT(Mistake("residue: imaginary"), HasSubstr("model.residue"));
  EXPECT_THAT(Mistake("modes: 2.5"), HasSubstr("model.modes"));
  EXPECT_THAT(
      Mistake("modes: 3", LoopsTaken::kPapers),
      HasSubstr(":3: model: states a loop that howl fit, simulate, predict and diagnose take"));
}

}  // namespace
}  // namespace howl::config_record_loop_test
