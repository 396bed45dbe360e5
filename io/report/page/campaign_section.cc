#include "io/report/page/campaign_section.h"

#include <cmath>
#include <vector>

#include "io/report/html_table.h"
#include "io/report/script.h"
#include "io/result_files.h"

namespace howl {
namespace {

constexpr std::size_t kMostRigs = 50;  // what a reader looks through; the CSV has all

std::string Count(const nlohmann::json& json, const char* key) {
  return Spelled(NumberAt(json, key), 7);
}

std::string VerdictTable(const nlohmann::json& campaign) {
  if (!campaign.contains("verdicts") || campaign["verdicts"].empty()) return {};
  std::vector<TableRow> rows;
  for (const auto& [verdict, count] : campaign["verdicts"].items()) {
    rows.push_back({verdict, Spelled(count.get<double>(), 7)});
  }
  return HtmlTable("Verdicts", {"verdict", "rigs"}, rows);
}

std::string ColumnTable(const nlohmann::json& campaign) {
  if (!campaign.contains("columns") || campaign["columns"].empty()) return {};
  std::vector<TableRow> rows;
  for (const auto& [column, numbers] : campaign["columns"].items()) {
    rows.push_back({column, Count(numbers, "count")});
    for (const char* const key : {"min", "quartile", "median", "upper_quartile", "max"}) {
      rows.back().push_back(TableCell(NumberAt(numbers, key)));
    }
  }
  return HtmlTable("Over all rigs",
                   {"", "rigs", "smallest", "quartile", "median", "upper quartile", "largest"},
                   rows);
}

std::string RigTable(const CsvTable& table) {
  const std::vector<std::string> columns = DifferingColumns(table);
  std::vector<TableRow> rows;
  for (std::size_t row = 0; row < table.rows.size() && row < kMostRigs; ++row) {
    rows.emplace_back();
    for (const std::string& column : columns) {
      const double number = table.Number(row, column);
      rows.back().push_back(std::isfinite(number) ? TableCell(number)
                                                  : TableCell(table.Text(row, column)));
    }
  }
  const std::string which = table.rows.size() > kMostRigs
                                ? "The first " + std::to_string(kMostRigs) + " of " +
                                      std::to_string(table.rows.size()) + " rigs"
                                : std::string("Rig by rig");
  return HtmlTable(which + ", what differs among them; all is in " + kCampaignCsv, columns, rows);
}

}  // namespace

std::string CampaignSummary(const ReportInput& input) {
  if (!input.campaign.is_object()) return {};
  std::string out = "<p>" + Count(input.campaign, "run") + " of " + Count(input.campaign, "rigs") +
                    " rigs, " + Count(input.campaign, "failed") + " with an error.</p>\n";
  out += VerdictTable(input.campaign) + ColumnTable(input.campaign);
  if (input.campaign_table) out += RigTable(*input.campaign_table);
  return out;
}

}  // namespace howl
