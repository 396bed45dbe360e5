// A trial's confusion matrix: the withheld effects against the diagnoses.
#include <algorithm>

#include "io/report/figures/catalogue.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

std::string Ticks(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : ", ") + TicLabel(names[i]) + " " + std::to_string(i + 1);
  }
  return text;
}

}  // namespace

std::optional<Figure> ConfusionFigure(const ReportInput& input) {
  if (!input.trial.contains("confusion")) return std::nullopt;
  const auto& confusion = input.trial["confusion"];
  const auto rows = confusion.at("withheld").get<std::vector<std::string>>();
  const auto columns = confusion.at("answer").get<std::vector<std::string>>();
  const auto counts = confusion.at("count").get<std::vector<std::vector<double>>>();
  if (rows.empty() || columns.empty()) return std::nullopt;
  CsvWriter csv("curve,column,row,share,count,withheld,answer");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double total = 0.0;
    for (const double count : counts.at(i)) total += count;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double count = counts[i].at(k);
      if (count == 0.0) continue;
      csv.Cell(rows[i] == columns[k] ? "right" : "other");
      csv.Cell(static_cast<double>(k + 1)).Cell(static_cast<double>(i + 1)).Cell(count / total);
      csv.Cell(count).Cell(rows[i]).Cell(columns[k]).EndRow();
    }
  }
  Figure figure;
  figure.title = "What was withheld, and what was answered";
  figure.caption =
      "Cases of the trial by the effect that the rig had (rows; none: no effect) and by the answer "
      "(columns). The shade is the row's share, the number counts cases; framed: the right name.";
  figure.csv = csv.Text();
  figure.width = static_cast<int>(std::max<std::size_t>(560, 260 + 30 * columns.size()));
  // Height in lines of the longest name, written aslant.
  std::size_t longest = 0;
  for (const std::string& name : columns) longest = std::max(longest, name.size());
  const double slant = 0.34 * static_cast<double>(longest);
  figure.height = static_cast<int>(70 + 6 * longest + 22 * rows.size());
  Script script;
  script.Line("unset key")
      .Line("unset grid")
      .Line("unset colorbox")
      .Line("set palette defined (0 '#eef5fb', 0.5 '#7fb3da', 1 '#3d85bd')")
      .Line("set cbrange [0:1]")
      .Line("set lmargin 27")
      .Line("set bmargin " + Number(3.0 + slant))
      .Line("set rmargin 3")
      .Line("set xtics noenhanced rotate by 50 right (" + Ticks(columns) + ")")
      .Line("set ytics noenhanced (" + Ticks(rows) + ")")
      .Line("set label 'answer' at graph 0.5, screen 0.04 center")
      .Line("set xrange [0.5:" + Number(static_cast<double>(columns.size()) + 0.5) + "]")
      .Line("set yrange [" + Number(static_cast<double>(rows.size()) + 0.5) + ":0.5]")
      .Line("set style fill solid noborder")
      .Plot(
          "data using 2:3:($2-0.48):($2+0.48):($3-0.46):($3+0.46):4 with boxxyerror linecolor "
          "palette")
      .Plot(
          "data using (pick('right',2)):3:($2-0.48):($2+0.48):($3-0.46):($3+0.46) with boxxyerror "
          "fill empty border rgb '" +
          std::string(colour::kVermillion) + "' linewidth 1.5")
      .Plot("data using 2:3:(sprintf('%d',$5)) with labels font ',10' textcolor rgb '#101010'")
      .EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
