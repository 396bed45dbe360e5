#include "app/campaign/campaign_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "app/campaign/rig_row.h"
#include "app/command_line/command.h"
#include "io/json_fields.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

// No table of howl has quoted cells, so that the simplest reader reads them: a comma in an error or
// a key becomes a semicolon.
std::string Unquoted(std::string text) {
  for (char& letter : text) {
    if (letter == ',') letter = ';';
    if (letter == '"') letter = '\'';
    if (letter == '\n') letter = ' ';
  }
  return text;
}

void AddCell(const Json& row, const std::string& column, CsvWriter& csv) {
  const auto found = row.find(column);
  if (found == row.end() || found->is_null()) {
    csv.Cell("");
  } else if (found->is_string()) {
    csv.Cell(Unquoted(found->get<std::string>()));
  } else if (found->is_number_float()) {
    csv.Cell(found->get<double>());
  } else {
    csv.Cell(found->dump());
  }
}

std::vector<std::string> ValueColumns(const CampaignSpec& spec) {
  std::vector<std::string> columns;
  for (const std::string& command : spec.commands) {
    std::ranges::copy(ResultColumns(command), std::back_inserter(columns));
  }
  return columns;
}

bool HasFailed(const Json& row) { return !row.at("error").get<std::string>().empty(); }

// Of sorted values, between its neighbours.
double Quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

bool IsRigRow(const nlohmann::json& row, const CampaignRigs& rigs) {
  const auto has = [&](const char* key, nlohmann::json::value_t type) {
    return JsonAt(row, key).type() == type;
  };
  using Type = nlohmann::json::value_t;
  const nlohmann::json& settings = ListAt(row, "settings");
  return has("rig", Type::string) && has("error", Type::string) && has("status", Type::object) &&
         has("values", Type::object) && has("points", Type::array) &&
         settings.size() == rigs.columns.size() &&
         std::ranges::all_of(settings, [](const auto& each) { return each.is_string(); });
}

std::string CampaignCsv(const CampaignSpec& spec, const CampaignRigs& rigs, const RigRows& rows) {
  const std::vector<std::string> values = ValueColumns(spec);
  std::string header = "rig,seed";
  for (const std::string& column : rigs.columns) {
    if (column != "seed") header += "," + Unquoted(column);
  }
  for (const std::string& command : spec.commands) header += "," + command + "_status";
  header += ",error";
  for (const std::string& column : values) header += "," + column;
  CsvWriter csv(header);
  for (const Json& row : rows) {
    AddCell(row, "rig", csv);
    AddCell(row, "seed", csv);
    for (std::size_t k = 0; k < rigs.columns.size(); ++k) {
      if (rigs.columns[k] != "seed") csv.Cell(Unquoted(row.at("settings")[k].get<std::string>()));
    }
    for (const std::string& command : spec.commands) AddCell(row.at("status"), command, csv);
    AddCell(row, "error", csv);
    for (const std::string& column : values) AddCell(row.at("values"), column, csv);
    csv.EndRow();
  }
  return csv.Text();
}

std::string CampaignPointsCsv(const RigRows& rows) {
  std::string header = "rig";
  for (const std::string& column : PointColumns()) header += "," + column;
  CsvWriter csv(header);
  for (const Json& row : rows) {
    for (const Json& point : row.at("points")) {
      AddCell(row, "rig", csv);
      for (const std::string& column : PointColumns()) AddCell(point, column, csv);
      csv.EndRow();
    }
  }
  return csv.Text();
}

Json CampaignJson(const CampaignSpec& spec, const CampaignRigs& rigs, const RigRows& rows) {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::size_t> verdicts;
  for (const Json& row : rows) {
    for (const auto& [column, value] : row.at("values").items()) {
      if (value.is_number()) numbers[column].push_back(value.get<double>());
    }
    const Json& values = row.at("values");
    if (!values.contains("verdict") || !values["verdict"].is_string()) continue;
    const bool has_effect = values.contains("effect") && values["effect"].is_string();
    ++verdicts[has_effect ? values["effect"].get<std::string>()
                          : values["verdict"].get<std::string>()];
  }
  Json columns = Json::object();
  for (const std::string& column : ValueColumns(spec)) {
    std::vector<double>& sorted = numbers[column];
    if (sorted.empty()) continue;
    std::ranges::sort(sorted);
    columns[column] = {{"count", sorted.size()},
                       {"min", sorted.front()},
                       {"quartile", Quantile(sorted, 0.25)},
                       {"median", Quantile(sorted, 0.5)},
                       {"upper_quartile", Quantile(sorted, 0.75)},
                       {"max", sorted.back()}};
  }
  Json counts = Json::object();
  for (const auto& [verdict, count] : verdicts) counts[verdict] = count;
  std::set<std::string> there;
  for (const Json& row : rows) there.insert(row.at("rig").get<std::string>());
  Json missing = Json::array();
  for (const CampaignRig& rig : rigs.rigs) {
    if (!there.contains(rig.name)) missing.push_back(rig.name);
  }
  return {{"schema", "howl.campaign/1"},
          {"title", spec.title},
          {"commands", spec.commands},
          {"rigs", rigs.rigs.size()},
          {"run", rows.size()},
          {"missing", missing},
          {"failed", std::ranges::count_if(rows, HasFailed)},
          {"verdicts", counts},
          {"columns", columns}};
}

}  // namespace howl
