#include "app/campaign/campaign_text.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "app/text/text_table.h"
#include "io/report/csv_table.h"
#include "io/result_files.h"

namespace howl {
namespace {

constexpr std::size_t kFewRigs = 20;
constexpr std::size_t kLongestCell = 8;  // a longer number is rounded

void PrintRigs(const CsvTable& table) {
  const std::vector<std::string> columns = DifferingColumns(table);
  TextTable text(columns);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    std::vector<std::string> cells;
    for (const std::string& column : columns) {
      const std::string cell = table.Text(row, column);
      const double number = table.Number(row, column);
      const bool is_long = cell.size() > kLongestCell && std::isfinite(number);
      cells.push_back(is_long ? Significant(number) : cell);
    }
    text.AddRow(std::move(cells));
  }
  std::printf("%s", text.Text().c_str());
}

void PrintColumns(const nlohmann::ordered_json& columns) {
  TextTable text({"", "rigs", "smallest", "median", "largest"});
  for (const auto& [column, numbers] : columns.items()) {
    text.AddRow({column, std::to_string(numbers["count"].get<std::size_t>()),
                 Significant(numbers["min"].get<double>()),
                 Significant(numbers["median"].get<double>()),
                 Significant(numbers["max"].get<double>())});
  }
  std::printf("%s", text.Text().c_str());
}

}  // namespace

void PrintCampaign(const nlohmann::ordered_json& summary, const std::filesystem::path& out) {
  const auto run = summary["run"].get<std::size_t>();
  std::printf("%zu of %zu rigs, %zu with an error\n", run, summary["rigs"].get<std::size_t>(),
              summary["failed"].get<std::size_t>());
  if (!summary["missing"].empty()) {
    std::string names;
    for (const auto& name : summary["missing"]) {
      names += (names.empty() ? "" : ", ") + name.get<std::string>();
    }
    std::printf("%s\n", Wrapped("not run, or changed since: " + names, 2).c_str());
  }
  for (const auto& [verdict, count] : summary["verdicts"].items()) {
    std::printf("  %-24s %zu\n", verdict.c_str(), count.get<std::size_t>());
  }
  if (run > 0 && run <= kFewRigs) {
    PrintRigs(ReadCsvTable(out / kCampaignCsv));
  } else if (run > 0) {
    PrintColumns(summary["columns"]);
  }
  std::printf("written: %s, %s and campaign.json in %s\n", kCampaignCsv, kCampaignPointsCsv,
              out.c_str());
}

}  // namespace howl
