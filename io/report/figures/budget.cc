// The budget of the gap: what each cause, added after those above it, takes off.
#include <algorithm>
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {

std::optional<Figure> BudgetFigure(const ReportInput& input) {
  const auto budget = input.diagnosis.find("budget");
  if (budget == input.diagnosis.end() || !budget->is_array() || budget->empty()) {
    return std::nullopt;
  }
  CsvWriter csv("curve,from,to,row,item");
  std::string names;
  std::size_t longest = 4;
  std::size_t row = 0;
  double gap = NAN;
  double widest = 0.0;
  for (const auto& entry : *budget) {
    const double before = NumberAt(entry, "gap_before");
    gap = NumberAt(entry, "gap_after");
    if (!std::isfinite(before) || !std::isfinite(gap)) return std::nullopt;
    const std::string item = entry.value("item", "");
    csv.Cell(gap <= before ? "taken" : "added").Cell(gap).Cell(before);
    csv.Cell(static_cast<double>(++row)).Cell(item).EndRow();
    names += Quoted(item) + " " + std::to_string(row) + ", ";
    longest = std::max(longest, item.size());
    widest = std::max({widest, before, gap});
  }
  csv.Cell("left").Cell(0.0).Cell(gap).Cell(static_cast<double>(++row)).Cell("left").EndRow();
  names += Quoted("left") + " " + std::to_string(row);
  Figure figure;
  figure.title = "Budget of the gap";
  figure.caption =
      "What each cause takes off the gap on operating points and halves of records left out of the "
      "fit, added after those above it. Last: what no cause explains.";
  figure.csv = csv.Text();
  figure.height = static_cast<int>(90 + 21 * row);
  Script script;
  script.Line("unset key")
      .Line("set xlabel 'gap, left out'")
      .Line("set lmargin " + Number(std::max(27.0, 0.85 * static_cast<double>(longest) + 1.0)))
      .Line("set ytics noenhanced (" + names + ")")
      .Line("set yrange [" + Number(static_cast<double>(row) + 0.7) + ":0.3]")
      .Line("set xrange [0:" + Number(1.05 * std::max(widest, 1e-6)) + "]")
      .Line("set style fill solid noborder");
  struct Style {
    const char* curve;
    const char* colour;
  };
  for (const Style& style : {Style{"taken", colour::kSky}, Style{"left", colour::kBlue}}) {
    script.Plot("data using (pick('" + std::string(style.curve) +
                "',2)):4:2:3:($4-0.32):($4+0.32) with boxxyerror linecolor rgb '" +
                std::string(style.colour) + "'");
  }
  if (csv.Text().find("added,") != std::string::npos) {
    script.Plot(
        "data using (pick('added',2)):4:3:2:($4-0.32):($4+0.32) with boxxyerror linecolor rgb '" +
        std::string(colour::kInk) + "'");
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
