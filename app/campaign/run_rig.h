// One unit of a campaign: the commands for one rig, each in a process of its own.
#ifndef HOWL_APP_CAMPAIGN_RUN_RIG_H_
#define HOWL_APP_CAMPAIGN_RUN_RIG_H_

#include <filesystem>
#include <optional>
#include <string>

#include "app/campaign/campaign_rigs.h"
#include "app/campaign/campaign_spec.h"

namespace howl {

// SHA-256 of all that a rig's row depends on beside the program.
std::string RigInputsSha256(const CampaignSpec& spec, const CampaignRig& rig);

// Writes the rig's config where it is a derived one.
void WriteRigConfig(const CampaignRig& rig);

// Runs the commands in the rig's folder; after simulate, the others take the config that it wrote.
// Returns the rig's row as JSON text, which depends on the rig alone:
//   {rig, seed, settings, inputs_sha256, status: {fit: 0, ...}, error, values, points}
// A command that fails ends the rig: `error` has its message. No value where the user has
// interrupted.
std::optional<std::string> RunRig(const CampaignSpec& spec, const CampaignRig& rig,
                                  const std::filesystem::path& out);

}  // namespace howl

#endif  // HOWL_APP_CAMPAIGN_RUN_RIG_H_
