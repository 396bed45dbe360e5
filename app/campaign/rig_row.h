// What a campaign keeps of a rig: one row of scalars, and a row for each quantity of each of its
// experiments.
#ifndef HOWL_APP_CAMPAIGN_RIG_ROW_H_
#define HOWL_APP_CAMPAIGN_RIG_ROW_H_

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace howl {

// The columns that a command's results fill, without those of its exit status.
const std::vector<std::string>& ResultColumns(const std::string& command);

// The file with a command's results.
std::string ResultFile(const std::string& command);

// Reads the result file of a command that ended: its scalars go to row["values"] by column, the
// quantities of its experiments to row["points"], a list of
//   {experiment, phi, quantity, value, std, outer_lo, inner_lo, inner_hi, outer_hi}.
// Throws UserError where the file is none of the command's.
void HarvestResults(const std::string& command, const std::filesystem::path& folder,
                    nlohmann::ordered_json& row);

// Of row["points"].
const std::vector<std::string>& PointColumns();

}  // namespace howl

#endif  // HOWL_APP_CAMPAIGN_RIG_ROW_H_
