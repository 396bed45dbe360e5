#include <glog/logging.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "io/report/csv_table.h"
#include "io/report/figures/catalogue.h"
#include "io/report/page/page.h"
#include "io/report/report_input.h"
#include "io/results/family/family_csv.h"
#include "io/results/reference_file.h"
#include "tests/fuzz/target.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

fs::path Folder() {
  fs::path folder = ScratchFolder() / "results";
  fs::create_directories(folder);
  return folder;
}

constexpr std::array<std::string_view, 18> kFiles = {
    "run.json",        "analysis.json",     "solution.json",   "family.json",
    "family.csv",      "tradeoff.csv",      "diagnosis.json",  "simulation.json",
    "trial.json",      "trial.csv",         "campaign.json",   "campaign.csv",
    "transfer.csv",    "lines.csv",         "flame_curve.csv", "campaign_points.csv",
    "prediction.json", "prediction_map.csv"};

// Figures take most of a report's time: most inputs go without.
void Report(std::string_view input, bool with_figures) {
  WriteFiles(Folder(), kFiles, input);
  Answered([&] {
    ReportInput report = ReadReportInput(Folder(), 1);
    std::vector<Figure> figures;
    if (with_figures) figures = AllFigures(report, 1, report.missing);
    CHECK(!ReportPage(report, figures, {}).empty());
  });
  std::error_code ignored;
  fs::remove_all(Folder() / "figures", ignored);
}

void Reference(std::string_view input) {
  const fs::path path = InputFile(input);
  Answered([&] {
    const nlohmann::ordered_json stored = ReadReference(path);
    CHECK(CompareReference(path, stored, stored, 1e-6).empty());
    (void)CompareReference(path, stored, {{"schema", kReferenceSchema}}, 1e-6);
  });
}

void Csv(std::string_view input) {
  const fs::path path = InputFile(input);
  try {
    const CsvTable table = ReadCsvTable(path);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      CHECK_EQ(table.rows[row].size(), table.columns.size());
    }
    (void)DifferingColumns(table);
  } catch (const std::runtime_error&) {
    // The callers add the file's name.
  }
  Answered([&] { (void)ReadFamilyCsv(path); });
}

}  // namespace

std::vector<FuzzTarget> ResultTargets() {
  return {{"results", [](std::string_view input) { Report(input, false); }},
          {"figures", [](std::string_view input) { Report(input, true); }},
          {"reference", Reference},
          {"csv", Csv}};
}

}  // namespace howl
