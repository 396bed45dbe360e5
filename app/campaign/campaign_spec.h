// CAMPAIGN.yaml: the same commands for many rigs.
//
//   title: burners of hall 3
//   commands: [analyse, fit, family, diagnose]  # for each rig, in this order; default [fit,
//   family] options: {diagnose: "--bootstrap 99"} configs: [rigs/*.yaml]          # either configs
//   as they are, config: template.yaml           # or one, changed for each rig fleet: rigs.csv #
//   by the columns of a table: rig, and keys of the config; grid:                           # and
//   for each value of a key, all combinations
//     family.test.omega_spread_max: [0.1, 0.25]
//     seed: {from: 1, to: 1000}
//
// Paths are relative to the folder of the file that names them. A key is written as in messages:
// experiments[0].record.file, or with the experiment's name, experiments.exp1.record.file.
#ifndef HOWL_APP_CAMPAIGN_CAMPAIGN_SPEC_H_
#define HOWL_APP_CAMPAIGN_CAMPAIGN_SPEC_H_

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/config/yaml/located_node.h"

namespace howl {

struct GridAxis {
  std::string key;
  int line = 0;  // in the campaign
  std::vector<LocatedNode> values;
};

struct CampaignSpec {
  std::filesystem::path source;
  std::string text;  // of the file
  std::string title;
  std::vector<std::string> commands;
  std::map<std::string, std::vector<std::string>> options;  // by command
  std::vector<std::filesystem::path> configs;               // one, where the rigs are made from it
  std::optional<std::filesystem::path> fleet;
  int fleet_line = 0;
  std::vector<GridAxis> grid;
  bool keeps_folders = true;  // of the rigs, once their rows are stored
};

// The commands that a campaign can have.
const std::vector<std::string>& CampaignCommands();

// Throws UserError.
CampaignSpec LoadCampaign(const std::filesystem::path& path);

}  // namespace howl

#endif  // HOWL_APP_CAMPAIGN_CAMPAIGN_SPEC_H_
