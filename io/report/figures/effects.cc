// The candidates of the diagnosis, ranked by how far each shrinks the gap on held-out experiments.
#include <algorithm>
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {

std::optional<Figure> EffectsFigure(const ReportInput& input) {
  if (!input.diagnosis.contains("candidates")) return std::nullopt;
  struct Row {
    std::string effect;
    double shrinkage, low, high;
  };
  std::vector<Row> rows;
  for (const auto& candidate : input.diagnosis["candidates"]) {
    Row row{candidate.value("effect", ""), NumberAt(candidate, "shrinkage"), NAN, NAN};
    const auto interval = candidate.find("shrinkage_interval");
    if (interval != candidate.end() && interval->is_array() && interval->size() == 2) {
      if ((*interval)[0].is_number()) row.low = (*interval)[0].get<double>();
      if ((*interval)[1].is_number()) row.high = (*interval)[1].get<double>();
    }
    if (std::isfinite(row.shrinkage)) rows.push_back(row);
  }
  if (rows.empty()) return std::nullopt;
  std::ranges::stable_sort(rows, std::greater<>(), &Row::shrinkage);
  const std::string verdict = input.diagnosis.contains("verdict")
                                  ? (input.diagnosis["verdict"]["effect"].is_string()
                                         ? input.diagnosis["verdict"]["effect"].get<std::string>()
                                         : std::string())
                                  : std::string();
  // An interval that runs far below zero would leave the others no room.
  constexpr double kLowest = -0.5;
  CsvWriter csv("curve,shrinkage_percent,row,lo_percent,hi_percent,effect");
  std::string names;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    csv.Cell(row.effect == verdict ? "verdict" : "other");
    csv.Cell(100.0 * std::max(row.shrinkage, kLowest)).Cell(static_cast<double>(i + 1));
    csv.Cell(100.0 * std::clamp(row.low, kLowest, 1.0)).Cell(100.0 * std::min(row.high, 1.0));
    csv.Cell(row.effect).EndRow();
    longest = std::max(longest, row.effect.size());
    names += (i == 0 ? "" : ", ") + TicLabel(row.effect) + " " + std::to_string(i + 1);
  }
  Figure figure;
  figure.title = "Effects by how far they shrink the gap";
  figure.caption =
      "Share of the gap that each effect removes on experiments left out of its fit, with 95 % "
      "intervals over the experiments (cut at −50 %)" +
      std::string(verdict.empty() ? "." : "; filled: the verdict.");
  figure.csv = csv.Text();
  // Names of several effects take their room from a wider figure.
  figure.width = std::max(figure.width, static_cast<int>(340 + 6.5 * static_cast<double>(longest)));
  figure.height = static_cast<int>(90 + 21 * rows.size());
  Script script;
  script.Line("unset key")
      .Line("set xlabel 'gap removed, held out (%)'")
      .Line("set lmargin " + Number(std::max(27.0, 0.85 * static_cast<double>(longest) + 1.0)))
      .Line("set ytics noenhanced (" + names + ")")
      .Line("set yrange [" + Number(static_cast<double>(rows.size()) + 0.7) + ":0.3]")
      .Line("set xrange [" + Number(100.0 * kLowest) + ":105]")
      .Line("set style fill solid noborder")
      .Line("set arrow from 0, graph 0 to 0, graph 1 nohead linewidth 0.8 linecolor rgb '" +
            std::string(colour::kInk) + "'");
  for (const char* curve : {"other", "verdict"}) {
    const std::string colour = curve == std::string("verdict") ? colour::kBlue : colour::kSky;
    if (curve == std::string("verdict") && verdict.empty()) continue;
    script.Plot("data using (pick('" + std::string(curve) +
                "',2)):3:(0):2:($3-0.32):($3+0.32) with boxxyerror linecolor rgb '" + colour + "'");
    script.Plot("data using (pick('" + std::string(curve) +
                "',4)):3:($5-$4):(0) with vectors nohead linewidth 1.3 linecolor rgb '" +
                std::string(colour::kInk) + "'");
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
