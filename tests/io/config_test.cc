// Well-formed configs: every key ends where it should.
#include "io/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "io/config/reading/config_reading.h"
#include "tests/io/config_file.h"

namespace howl::config_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string kGood =
    "experiments:\n  - {name: exp1, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, "
    "gain: 12.14}\n";

Config Load(const std::string& text) { return LoadConfig(ConfigFile(text).Path()); }

TEST(Config, PublishedNumbers) {
  const Config config = Load(
      "title: Test R228\n"
      "experiments:\n"
      "  - {name: exp1, phi: 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14,\n"
      "     flame_slope: -0.703e-4, reliable: false, frequency_std_hz: 0.3, phase_std_deg: 0.5,\n"
      "     gain_std: 0.12, flame_slope_std: 2e-6,\n"
      "     lines: [{frequency_hz: 750, frequency_std_hz: 5}, {frequency_hz: 1e3}]}\n"
      "  - name: 2\n"
      "    phi: -1\n"
      "    frequency_hz: 210\n"
      "    phase_deg: 0\n"
      "    gain: .5\n");
  EXPECT_EQ(config.title, "Test R228");
  EXPECT_EQ(config.operating_parameter, "phi");
  ASSERT_EQ(config.experiments.size(), 2u);
  const Experiment& first = config.experiments[0].experiment;
  EXPECT_EQ(first.name, "exp1");
  EXPECT_EQ(first.phi, 0.56);
  EXPECT_EQ(first.frequency_hz, 219.9);
  EXPECT_EQ(first.phase_deg, -5.74);
  EXPECT_EQ(first.gain, 12.14);
  EXPECT_EQ(first.flame_slope, -0.703e-4);
  EXPECT_FALSE(first.reliable);
  EXPECT_EQ(first.frequency_std_hz, 0.3);
  EXPECT_EQ(first.phase_std_deg, 0.5);
  EXPECT_EQ(first.gain_std, 0.12);
  EXPECT_EQ(first.flame_slope_std, 2e-6);
  ASSERT_EQ(first.lines.size(), 2u);
  EXPECT_EQ(first.lines[0].frequency_hz, 750.0);
  EXPECT_EQ(first.lines[0].frequency_std_hz, 5.0);
  EXPECT_EQ(first.lines[1].frequency_hz, 1000.0);
  EXPECT_EQ(first.lines[1].frequency_std_hz, 0.0);
  EXPECT_EQ(config.experiments[0].line, 3);
  EXPECT_FALSE(config.experiments[0].record);
  const Experiment& second = config.experiments[1].experiment;
  EXPECT_EQ(second.name, "2");
  EXPECT_EQ(second.phi, -1.0);
  EXPECT_EQ(second.gain, 0.5);
  EXPECT_TRUE(second.reliable);
  EXPECT_FALSE(second.flame_slope);
  EXPECT_FALSE(second.gain_std);
  EXPECT_EQ(config.experiments[1].line, 7);
}

TEST(Config, OperatingParameterTakesThePlaceOfPhi) {
  const Config config = Load(
      "operating_parameter: air_slpm\nexperiments:\n  - {name: a, air_slpm: 20.5, "
      "frequency_hz: 100, phase_deg: 1, gain: 2}\n");
  EXPECT_EQ(config.operating_parameter, "air_slpm");
  EXPECT_EQ(config.experiments[0].experiment.phi, 20.5);
}

TEST(Config, Record) {
  const ConfigFile file(
      "experiments:\n"
      "  - name: exp2\n"
      "    phi: 0.53\n"
      "    reliable: false\n"
      "    record:\n"
      "      {pressure: p1, heat_release: 3, time: t, sampling_hz: 5000, pressure_scale: 1e3,\n"
      "       heat_release_scale: -2, start_s: 0.5, duration_s: 3,\n"
      "       file: data/exp2.csv}\n"
      "  - {name: exp3, phi: 0.5, record: {file: 'data/${HOWL_TEST_FOLDER}/exp3.csv',\n"
      "     sampling_hz: 4e3}}\n");
  std::filesystem::create_directories(file.Folder() / "data" / "inner");
  file.Write("data/exp2.csv", "");
  file.Write("data/inner/exp3.csv", "");
  ASSERT_EQ(setenv("HOWL_TEST_FOLDER", "inner", 1), 0);
  const Config config = LoadConfig(file.Path());
  unsetenv("HOWL_TEST_FOLDER");
  ASSERT_EQ(config.experiments.size(), 2u);
  ASSERT_TRUE(config.experiments[0].record);
  const RecordSpec& record = *config.experiments[0].record;
  EXPECT_EQ(record.file, (file.Folder() / "data" / "exp2.csv").lexically_normal());
  EXPECT_EQ(record.pressure, "p1");
  EXPECT_EQ(record.heat_release, "3");
  EXPECT_EQ(record.time, "t");
  EXPECT_EQ(record.sampling_hz, 5000.0);
  EXPECT_EQ(record.pressure_scale, 1000.0);
  EXPECT_EQ(record.heat_release_scale, -2.0);
  EXPECT_EQ(record.start_s, 0.5);
  EXPECT_EQ(record.duration_s, 3.0);
  EXPECT_FALSE(config.experiments[0].experiment.reliable);
  EXPECT_EQ(config.experiments[0].experiment.name, "exp2");
  EXPECT_EQ(config.experiments[0].experiment.phi, 0.53);
  EXPECT_EQ(config.experiments[0].line, 2);
  EXPECT_EQ(config.experiments[0].record_line, 8);
  const RecordSpec& other = *config.experiments[1].record;
  EXPECT_EQ(other.file, (file.Folder() / "data/inner/exp3.csv").lexically_normal());
  EXPECT_EQ(other.sampling_hz, 4000.0);
  EXPECT_EQ(other.pressure, "p");
  EXPECT_FALSE(other.heat_release);
}

TEST(Config, AbsoluteRecordPathStaysAsItIs) {
  const ConfigFile data("x: 1\n");
  const Config config = Load("experiments:\n  - {name: a, phi: 1, record: {file: '" +
                             data.Path().string() + "', time: 1}}\n");
  EXPECT_EQ(config.experiments[0].record->file, data.Path().lexically_normal());
  EXPECT_FALSE(config.experiments[0].record->sampling_hz);
}

TEST(Config, ModelAndParameters) {
  const Config config = Load(kGood +
                             "model: {modes: 2, harmonic_ratio: 2.9}\n"
                             "parameters:\n"
                             "  omega_hz: {scope: shared, initial: 215, min: 150, max: 300}\n"
                             "  xi: {initial: 0.2, fixed: true}\n"
                             "  M: {scope: experiment, max: 1e7}\n");
  const ModelSpec& model = config.model;
  const ModelSpec defaults = DefaultModelSpec();
  EXPECT_EQ(model.modes, 2);
  EXPECT_EQ(model.harmonic_ratio, 2.9);
  EXPECT_FALSE(model.second_mode_relative);
  EXPECT_EQ(model[ParameterKind::kOmega].scope, ParameterScope::kShared);
  EXPECT_EQ(model[ParameterKind::kOmega].initial, 215.0);
  EXPECT_EQ(model[ParameterKind::kOmega].min, 150.0);
  EXPECT_EQ(model[ParameterKind::kOmega].max, 300.0);
  EXPECT_FALSE(model[ParameterKind::kOmega].fixed);
  EXPECT_TRUE(model[ParameterKind::kXi].fixed);
  EXPECT_EQ(model[ParameterKind::kXi].initial, 0.2);
  EXPECT_EQ(model[ParameterKind::kXi].max, defaults[ParameterKind::kXi].max);
  EXPECT_EQ(model[ParameterKind::kM].scope, ParameterScope::kExperiment);
  EXPECT_EQ(model[ParameterKind::kM].max, 1e7);
  EXPECT_EQ(model[ParameterKind::kTau].min, defaults[ParameterKind::kTau].min);
}

TEST(Config, NamingMOverNMakesTheSecondModeRelative) {
  const Config config = Load(kGood + "model: {modes: 2}\nparameters: {M_over_N: {initial: 0.4}}\n");
  EXPECT_TRUE(config.model.second_mode_relative);
  EXPECT_TRUE(config.model.Uses(ParameterKind::kMOverN));
  EXPECT_EQ(config.model[ParameterKind::kMOverN].initial, 0.4);
  EXPECT_EQ(config.model[ParameterKind::kMOverN].scope, ParameterScope::kShared);
}

TEST(Config, Residuals) {
  const Config config =
      Load(kGood +
           "residuals:\n"
           "  unreliable_weight: 0.1\n"
           "  gain_equality: {enabled: true, std_relative: 0.02, weight: 3, loss: tukey,\n"
           "                  loss_scale: 2.5, experiments: [exp1], form: reduced}\n"
           "  phase_equality: {std_deg: 0.7, form: full, loss: cauchy}\n"
           "  limit_cycle_phase: {std_deg: 2, loss: soft_l1}\n"
           "  limit_cycle_gain: {std: 0.1, loss: huber}\n"
           "  second_crossing: {std_deg: 6, loss: none}\n"
           "  omega_prior: {std_relative: 0.06}\n"
           "  xi_increasing: {std: 0.03, enabled: false}\n"
           "  damping_prior: off\n"
           "  tau_prior: false\n");
  const ResidualSet& set = config.residuals;
  EXPECT_EQ(set.unreliable_weight, 0.1);
  const ResidualSpec& gain = set[ResidualKind::kGainEquality];
  EXPECT_TRUE(gain.enabled);
  EXPECT_EQ(gain.std, 0.02);
  EXPECT_EQ(gain.weight, 3.0);
  EXPECT_EQ(gain.loss, LossKind::kTukey);
  EXPECT_EQ(gain.loss_scale, 2.5);
  EXPECT_THAT(gain.experiments, ElementsAre("exp1"));
  EXPECT_EQ(gain.form, EquationForm::kReduced);
  EXPECT_EQ(set[ResidualKind::kPhaseEquality].std, 0.7);
  EXPECT_EQ(set[ResidualKind::kPhaseEquality].form, EquationForm::kFull);
  EXPECT_EQ(set[ResidualKind::kPhaseEquality].loss, LossKind::kCauchy);
  EXPECT_THAT(set[ResidualKind::kPhaseEquality].experiments, IsEmpty());
  EXPECT_EQ(set[ResidualKind::kLimitCyclePhase].std, 2.0);
  EXPECT_EQ(set[ResidualKind::kLimitCyclePhase].loss, LossKind::kSoftL1);
  EXPECT_EQ(set[ResidualKind::kLimitCycleGain].std, 0.1);
  EXPECT_EQ(set[ResidualKind::kLimitCycleGain].loss, LossKind::kHuber);
  EXPECT_EQ(set[ResidualKind::kSecondCrossing].std, 6.0);
  EXPECT_EQ(set[ResidualKind::kSecondCrossing].loss, LossKind::kNone);
  EXPECT_EQ(set[ResidualKind::kOmegaPrior].std, 0.06);
  EXPECT_EQ(set[ResidualKind::kXiIncreasing].std, 0.03);
  EXPECT_FALSE(set[ResidualKind::kXiIncreasing].enabled);
  EXPECT_FALSE(set[ResidualKind::kDampingPrior].enabled);
  EXPECT_FALSE(set[ResidualKind::kTauPrior].enabled);
  EXPECT_EQ(set[ResidualKind::kTauPrior].std, DefaultResidualSet()[ResidualKind::kTauPrior].std);
}

TEST(Config, SolverFamilyAnalysis) {
  const Config config = Load(
      kGood +
      "solver: {starts: 3, max_iterations: 1e3}\n"
      "family:\n"
      "  members: 50\n"
      "  width: 0.001\n"
      "  test: {gain_tolerance: 0.02, phase_tolerance_deg: 0.6, loop_phase_tolerance_deg: 2,\n"
      "         loop_gain_min: 1.1, second_crossing_tolerance_deg: 12, omega_spread_max: 0.15,\n"
      "         xi_max: 0.4, xi_increasing: false, transfer_distance_max: 3.08}\n"
      "analysis: {method: paper, delay_branch: 1, min_frequency_hz: 50, max_frequency_hz: 400}\n");
  EXPECT_EQ(config.solver.starts, 3);
  EXPECT_EQ(config.solver.max_iterations, 1000);
  EXPECT_EQ(config.family.members, 50);
  EXPECT_EQ(config.family.width, 0.001);
  const MembershipTest& test = config.family.test;
  EXPECT_EQ(test.gain_tolerance, 0.02);
  EXPECT_EQ(test.phase_tolerance_deg, 0.6);
  EXPECT_EQ(test.loop_phase_tolerance_deg, 2.0);
  EXPECT_EQ(test.loop_gain_min, 1.1);
  EXPECT_EQ(test.second_crossing_tolerance_deg, 12.0);
  EXPECT_EQ(test.omega_spread_max, 0.15);
  EXPECT_EQ(test.xi_max, 0.4);
  EXPECT_FALSE(test.xi_increasing);
  EXPECT_EQ(test.transfer_distance_max, 3.08);
  EXPECT_EQ(config.analysis.method, CharacteristicsMethod::kPaper);
  EXPECT_EQ(Load(kGood + "analysis: {method: seed}\n").analysis.method,
            CharacteristicsMethod::kPaper);
  EXPECT_EQ(config.analysis.delay_branch, 1);
  EXPECT_EQ(config.analysis.min_frequency_hz, 50.0);
  EXPECT_EQ(config.analysis.max_frequency_hz, 400.0);
}

TEST(Config, NullSwitchesAConditionOff) {
  const Config config =
      Load(kGood +
           "family: {test: {gain_tolerance: null, phase_tolerance_deg: ~, loop_gain_min: null,\n"
           "  loop_phase_tolerance_deg: null, second_crossing_tolerance_deg: null,\n"
           "  omega_spread_max: null, xi_max: null, transfer_distance_max: null}}\n");
  const MembershipTest& test = config.family.test;
  EXPECT_TRUE(std::isinf(test.gain_tolerance));
  EXPECT_TRUE(std::isinf(test.phase_tolerance_deg));
  EXPECT_TRUE(std::isinf(test.loop_phase_tolerance_deg));
  EXPECT_TRUE(std::isinf(test.second_crossing_tolerance_deg));
  EXPECT_TRUE(std::isinf(test.omega_spread_max));
  EXPECT_TRUE(std::isinf(test.xi_max));
  EXPECT_TRUE(std::isinf(test.transfer_distance_max));
  EXPECT_EQ(test.loop_gain_min, 0.0);
}

TEST(Config, AnchorsAliasesAndMergeKeys) {
  const Config config = Load(
      "experiments:\n"
      "  - &first {name: exp1, phi: &p 0.56, frequency_hz: 219.9, phase_deg: -5.74, gain: 12}\n"
      "  - {<<: *first, name: exp2, gain: 13}\n"
      "  - {name: exp3, phi: *p, frequency_hz: 1, phase_deg: 2, gain: 3}\n");
  ASSERT_EQ(config.experiments.size(), 3u);
  const Experiment& second = config.experiments[1].experiment;
  EXPECT_EQ(second.name, "exp2");
  EXPECT_EQ(second.gain, 13.0);
  EXPECT_EQ(second.frequency_hz, 219.9);
  EXPECT_EQ(config.experiments[2].experiment.phi, 0.56);
}

TEST(Config, TextThatLooksOtherwise) {
  const Config config = Load(
      "title: \"on # \\\"quoted\\\" {\"\n"
      "experiments:\r\n"
      "  - name: 'Pr\xc3\xbc"
      "fstand 3'  # a comment [\r\n"
      "    phi: +5.6e-1\r\n"
      "    frequency_hz: 0219.9\r\n"
      "    phase_deg: -0\r\n"
      "    gain: 12.\r\n");
  EXPECT_EQ(config.title, "on # \"quoted\" {");
  EXPECT_EQ(config.experiments[0].experiment.name,
            "Pr\xc3\xbc"
            "fstand 3");
  EXPECT_EQ(config.experiments[0].experiment.phi, 0.56);
  EXPECT_EQ(config.experiments[0].experiment.frequency_hz, 219.9);
  EXPECT_EQ(config.experiments[0].experiment.gain, 12.0);
}

TEST(Config, ByteOrderMarkAndJson) {
  const Config config = Load(
      "\xef\xbb\xbf{\"experiments\": [{\"name\": \"a\", \"phi\": 1, \"frequency_hz\": 100,\n"
      "\"phase_deg\": -3, \"gain\": 2}]}");
  EXPECT_EQ(config.experiments[0].experiment.phase_deg, -3.0);
}

TEST(Config, TwoThousandExperiments) {
  std::string text = "experiments:\n";
  for (int i = 0; i < 2000; ++i) {
    text += "  - {name: e" + std::to_string(i) +
            ", phi: 0.5, frequency_hz: 200, phase_deg: 1, gain: 2}\n";
  }
  const Config config = Load(text);
  EXPECT_EQ(config.experiments.size(), 2000u);
  EXPECT_EQ(config.experiments.back().line, 2001);
}

}  // namespace
}  // namespace howl::config_test
