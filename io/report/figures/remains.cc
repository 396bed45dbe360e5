// The gap before, the gap with the best effect, and the floor that a right model leaves.
#include <algorithm>
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {

std::optional<Figure> RemainsFigure(const ReportInput& input) {
  if (!input.diagnosis.contains("gap")) return std::nullopt;
  const auto& gap = input.diagnosis["gap"];
  CsvWriter csv("curve,gap,row");
  struct Bar {
    const char* key;
    const char* label;
    const char* colour;
  };
  const Bar bars[] = {{"before", "the model as it is", colour::kVermillion},
                      {"after", "with the best effect", colour::kBlue},
                      {"floor", "floor: a right model", colour::kGrey}};
  std::string names;
  int count = 0;
  double widest = 1e-3;
  for (const Bar& bar : bars) {
    const double value = NumberAt(gap, bar.key);
    if (!std::isfinite(value)) continue;
    ++count;
    widest = std::max(widest, value);
    csv.Cell(bar.key).Cell(value).Cell(static_cast<double>(count)).EndRow();
    names += (count == 1 ? "" : ", ") + TicLabel(bar.label) + " " + std::to_string(count);
  }
  if (count == 0) return std::nullopt;
  Figure figure;
  figure.title = "What remains of the gap";
  figure.caption =
      "Held out: root mean excess of the residuals' power over their noise. 0 means "
      "that model and rig cannot be told apart.";
  figure.csv = csv.Text();
  figure.height = 90 + 34 * count;
  Script script;
  script.Line("unset key")
      .Line("set xlabel 'gap (1: as much again as the noise)'")
      .Line("set lmargin 24")
      .Line("set xrange [0:" + Number(1.2 * widest) + "]")
      .Line("set ytics (" + names + ")")
      .Line("set yrange [" + Number(count + 0.6) + ":0.4]")
      .Line("set style fill solid noborder");
  for (const Bar& bar : bars) {
    if (!std::isfinite(NumberAt(gap, bar.key))) continue;
    script.Plot("data using (pick('" + std::string(bar.key) +
                "',2)):3:(0):2:($3-0.3):($3+0.3) with boxxyerror linecolor rgb '" + bar.colour +
                "'");
    script.Plot("data using (pick('" + std::string(bar.key) +
                "',2)):3:(sprintf('%.3f',$2)) with labels left offset 0.6,0");
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
