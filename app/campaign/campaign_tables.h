// The results of a campaign over all its rigs.
#ifndef HOWL_APP_CAMPAIGN_CAMPAIGN_TABLES_H_
#define HOWL_APP_CAMPAIGN_CAMPAIGN_TABLES_H_

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/campaign/campaign_rigs.h"
#include "app/campaign/campaign_spec.h"

namespace howl {

using RigRows = std::vector<nlohmann::ordered_json>;  // as RunRig gives them, in the rigs' order

// Whether it has all that the tables below take from a row.
bool IsRigRow(const nlohmann::json& row, const CampaignRigs& rigs);

// A row for each rig: rig, seed, what differs from rig to rig, the exit status of each command, an
// error, and what the commands found.
std::string CampaignCsv(const CampaignSpec& spec, const CampaignRigs& rigs, const RigRows& rows);

// A row for each quantity of each experiment of each rig.
std::string CampaignPointsCsv(const RigRows& rows);

// howl.campaign/1: how many rigs there are, were run and failed; those that are missing; counts of
// verdicts; and of each column of numbers count, smallest, quartiles and largest.
nlohmann::ordered_json CampaignJson(const CampaignSpec& spec, const CampaignRigs& rigs,
                                    const RigRows& rows);

}  // namespace howl

#endif  // HOWL_APP_CAMPAIGN_CAMPAIGN_TABLES_H_
