// The rigs of a campaign: each is one config, as it is or derived, and a random seed.
#ifndef HOWL_APP_CAMPAIGN_CAMPAIGN_RIGS_H_
#define HOWL_APP_CAMPAIGN_CAMPAIGN_RIGS_H_

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/campaign/campaign_spec.h"

namespace howl {

struct CampaignRig {
  std::string name;              // of its folder and its row; unique
  std::filesystem::path config;  // as it is, or where a derived one belongs
  std::string config_text;
  bool is_derived = false;
  std::vector<std::filesystem::path> input_files;  // that the config names
  std::vector<std::string> settings;               // of CampaignRigs::columns
  std::uint64_t seed = 1;
};

struct CampaignRigs {
  std::vector<std::string> columns;  // the keys that differ from rig to rig
  std::vector<CampaignRig> rigs;
};

// `seed` where the campaign sets none. Throws UserError.
CampaignRigs MakeRigs(const CampaignSpec& spec, std::uint64_t seed,
                      const std::filesystem::path& out);

// The folder of a rig's results.
std::filesystem::path RigFolder(const std::filesystem::path& out, const std::string& name);

}  // namespace howl

#endif  // HOWL_APP_CAMPAIGN_CAMPAIGN_RIGS_H_
