// A trial's power: the severity that an effect must have for the diagnosis to name it in 90 % of
// cases.
#include <algorithm>
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

// Severities of a trial run from small (-1) over medium (0) to large (1); estimates far outside are
// cut.
constexpr double kEdge = 2.0;

}  // namespace

std::optional<Figure> PowerFigure(const ReportInput& input) {
  if (!input.trial.contains("power") || input.trial["power"].empty()) return std::nullopt;
  CsvWriter csv("curve,severity,row,lo,hi,effect,found,cases");
  std::string names;
  int row = 0;
  for (const auto& each : input.trial["power"]) {
    const double severity = NumberAt(each, "severity");
    if (!std::isfinite(severity)) continue;
    ++row;
    const std::string effect = each.value("effect", "");
    const auto edge = [&](std::size_t side) {
      const auto& interval = each.at("severity_interval");
      return interval.at(side).is_number() ? std::clamp(interval[side].get<double>(), -kEdge, kEdge)
                                           : (side == 0 ? -kEdge : kEdge);
    };
    csv.Cell(each.value("resolved", false) ? "resolved" : "not resolved");
    csv.Cell(std::clamp(severity, -kEdge, kEdge)).Cell(static_cast<double>(row));
    csv.Cell(edge(0)).Cell(edge(1)).Cell(effect).Cell(NumberAt(each, "found"));
    csv.Cell(NumberAt(each, "cases")).EndRow();
    names += (row == 1 ? "" : ", ") + TicLabel(effect) + " " + std::to_string(row);
  }
  if (row == 0) return std::nullopt;
  Figure figure;
  figure.title = "How large an effect is found";
  figure.caption =
      "Severity at which an effect is named in 90 % of cases, with 95 % intervals (cut at the "
      "edges); open: too few cases to resolve it. Beside it: cases named of all. Further to the "
      "left is better.";
  figure.csv = csv.Text();
  figure.height = 110 + 21 * row;
  Script script;
  script.Line("unset key")
      .Line("set lmargin 27")
      .Line("set rmargin 9")
      .Line("set xlabel 'severity that is named in 90 % of cases'")
      .Line("set xtics ('small' -1, 'medium' 0, 'large' 1)")
      .Line("set xrange [" + Number(-kEdge) + ":" + Number(kEdge) + "]")
      .Line("set ytics noenhanced (" + names + ")")
      .Line("set yrange [" + Number(row + 0.6) + ":0.4]")
      .Plot("data using 4:3:($5-$4):(0) with vectors nohead linewidth 1.4 linecolor rgb '" +
            std::string(colour::kBlue) + "'")
      .Plot(
          "data using (pick('resolved',2)):3 with points pointtype 7 pointsize 0.9 linecolor rgb "
          "'" +
          std::string(colour::kBlue) + "'")
      .Plot(
          "data using (pick('not resolved',2)):3 with points pointtype 6 pointsize 0.9 linewidth "
          "1.4 linecolor rgb '" +
          std::string(colour::kBlue) + "'")
      .Plot("data using (" + Number(kEdge) +
            "):3:(sprintf('%d of %d',$7,$8)) with labels left offset 1,0 font ',11'")
      .EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
