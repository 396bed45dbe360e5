// howl_rig as the trial uses it: a program beside this one, told what to withhold through its
// standard input, so that nothing of it is on a disk.
#ifndef HOWL_APP_TRIAL_TRIAL_RIG_H_
#define HOWL_APP_TRIAL_TRIAL_RIG_H_

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "estimation/analysis/loop/experiment.h"
#include "io/config/config.h"
#include "trial/case_plan.h"

namespace howl {

// What all rigs of a trial have in common.
struct RigTemplate {
  std::vector<Experiment> experiments;
  std::string operating_parameter;
  double duration_s = 3.2;
  double sampling_hz = 5000.0;
  double settle_s = 1.0;
  std::optional<double> combustion_noise;
  std::optional<double> sensor_noise;
};

// From the config's characteristics, or from those of its records; with the records' length and
// sampling rate where there are any, else with the config's `simulate:`; options come first.
RigTemplate MakeRigTemplate(const Config& config, const Options& options);

std::string RigSpecYaml(const RigTemplate& rig_template, const CasePlan& plan);

std::vector<RigEffect> ListRigEffects();

// Writes config.yaml and data/ to the folder; the key comes back.
nlohmann::json MakeRig(const RigTemplate& rig_template, const CasePlan& plan,
                       const std::filesystem::path& folder);

}  // namespace howl

#endif  // HOWL_APP_TRIAL_TRIAL_RIG_H_
