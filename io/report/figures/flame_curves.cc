// Figure 6 of the paper: the flame's characteristic in every experiment.
#include <cmath>
#include <set>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {

std::optional<Figure> FlameCurvesFigure(const ReportInput& input) {
  CsvWriter csv("curve,delayed_derivative,q,q_std");
  std::vector<std::pair<std::string, double>> names;
  const auto add = [&](const std::string& name, double phi, double x, double q, double std) {
    if (names.empty() || names.back().first != name) names.emplace_back(name, phi);
    csv.Cell(name).Cell(x).Cell(q).Cell(std).EndRow();
  };
  const bool measured = input.flame_curve.has_value();
  if (measured) {
    const CsvTable& table = *input.flame_curve;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      add(table.Text(row, "name"), table.Number(row, "phi"),
          table.Number(row, "delayed_derivative"), table.Number(row, "q"),
          table.Number(row, "q_std"));
    }
  } else {
    for (const Analysis& analysis : input.simulated_analysis.analyses) {
      if (!analysis.flame_curve) continue;
      for (const FlameCurveBin& bin : analysis.flame_curve->bins) {
        add(analysis.name, analysis.phi, bin.x, bin.q, bin.q_std);
      }
    }
  }
  if (names.empty()) return std::nullopt;
  Figure figure;
  figure.title = measured ? "Flame characteristics" : "Flame characteristics, simulated records";
  figure.caption =
      "Means of q in bins of the delayed derivative of pressure, for each operating point." +
      std::string(measured ? "" : " Simulated: no measured record is at hand.");
  std::string raised;
  for (const auto& [name, phi] : names) {
    for (const auto& loop : ListAt(input.simulation, "experiments")) {
      if (measured || loop.value("name", "") != name || !loop.value("slope_raised", false))
        continue;
      raised += (raised.empty() ? "" : ", ") + name;
    }
  }
  if (!raised.empty()) {
    figure.caption += " The flame's slope was raised before simulating " + raised +
                      ", where the loop would not have cycled with the measured one.";
  }
  figure.csv = csv.Text();
  Script script;
  script.Line("set xlabel 'delayed derivative of p (units of p per second)'")
      .Line("set format x '%.1s%c'")
      .Line("set ylabel 'q (units of the record)'")
      .Line("set key outside top center horizontal maxcols 3");
  for (std::size_t i = 0; i < names.size(); ++i) {
    script.Plot("data using (pick(" + Quoted(names[i].first) +
                ",2)):3 with linespoints pointsize 0.45 linewidth 1.2 pointtype " +
                std::to_string(SeriesPoint(i)) + " linecolor rgb '" +
                SeriesColour(i, names.size()) + "' title " +
                Quoted(names[i].first + " (" + Number(names[i].second) + ")"));
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
