// A campaign on the terminal.
#ifndef HOWL_APP_CAMPAIGN_CAMPAIGN_TEXT_H_
#define HOWL_APP_CAMPAIGN_CAMPAIGN_TEXT_H_

#include <filesystem>
#include <nlohmann/json.hpp>

namespace howl {

// Few rigs with what differs among them, from campaign.csv; of many, smallest, median and largest
// of each column. `summary`: CampaignJson.
void PrintCampaign(const nlohmann::ordered_json& summary, const std::filesystem::path& out);

}  // namespace howl

#endif  // HOWL_APP_CAMPAIGN_CAMPAIGN_TEXT_H_
