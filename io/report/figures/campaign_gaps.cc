// The gap of each rig of a campaign, of the model alone and with the best effect, the largest
// first.
#include <algorithm>
#include <cmath>
#include <vector>

#include "io/report/figures/catalogue.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {

std::optional<Figure> CampaignGapsFigure(const ReportInput& input) {
  if (!input.campaign_table) return std::nullopt;
  const CsvTable& table = *input.campaign_table;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (std::isfinite(table.Number(row, "gap_before"))) rows.push_back(row);
  }
  if (rows.empty()) return std::nullopt;
  std::ranges::stable_sort(rows, std::greater(),
                           [&](std::size_t row) { return table.Number(row, "gap_before"); });
  CsvWriter csv("curve,place,before,after,floor,rig");
  double place = 0.0;
  for (const std::size_t row : rows) {
    csv.Cell("gap").Cell(++place).Cell(table.Number(row, "gap_before"));
    csv.Cell(table.Number(row, "gap_after")).Cell(table.Number(row, "gap_floor"));
    csv.Cell(table.Text(row, "rig")).EndRow();
  }
  Figure figure;
  figure.title = "The gap between model and rig";
  figure.caption =
      "Of each rig, the largest first: the gap of the model alone, and with the best effect added; "
      "grey: what sampling alone gives.";
  figure.csv = csv.Text();
  Script script;
  const auto points = [](int column, const char* colour, const char* title) {
    return "data using (pick('gap',2)):" + std::to_string(column) +
           " with points pointtype 7 pointsize 0.5 linecolor rgb '" + colour + "' title '" + title +
           "'";
  };
  script.Line("set xlabel 'rig, by its gap'")
      .Line("set ylabel 'gap'")
      .Line("set yrange [0:*]")
      .Line("set xrange [0:" + Number(place + 1.0) + "]")
      .Line("set key top right")
      .Plot(points(5, colour::kGrey, "sampling alone"))
      .Plot(points(3, colour::kVermillion, "model alone"))
      .Plot(points(4, colour::kBlue, "with the best effect"))
      .EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
