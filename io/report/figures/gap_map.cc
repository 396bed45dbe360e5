// The map of the gap: blocks of the loop, frequency bands and experiments where the model falls
// short.
#include <algorithm>
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {

std::optional<Figure> GapMapFigure(const ReportInput& input) {
  if (!input.diagnosis.contains("map") || !input.diagnosis["map"].is_array()) return std::nullopt;
  const auto& cells = input.diagnosis["map"];
  std::vector<std::string> experiments;
  double low = INFINITY;
  double high = 0.0;
  double top = 0.0;
  for (const auto& cell : cells) {
    const std::string name = cell.value("experiment", "");
    if (std::ranges::find(experiments, name) == experiments.end()) experiments.push_back(name);
  }
  CsvWriter csv(
      "curve,band_lo_hz,band_hi_hz,row,excess_before,excess_after,experiment,found_before,found_"
      "after");
  bool any_after = false;
  for (const auto& cell : cells) {
    const auto& band = cell.at("band_hz");
    const double from = band.at(0).get<double>();
    const double to = band.at(1).get<double>();
    const auto row = std::ranges::find(experiments, cell.value("experiment", ""));
    const double before = NumberAt(cell, "before");
    const double after = NumberAt(cell, "after");
    any_after = any_after || std::isfinite(after);
    low = std::min(low, from);
    high = std::max(high, to);
    top = std::max({top, before, std::isfinite(after) ? after : 0.0});
    csv.Cell(cell.value("signal", "")).Cell(from).Cell(to);
    csv.Cell(static_cast<double>(row - experiments.begin() + 1)).Cell(before).Cell(after);
    csv.Cell(*row);
    for (const char* found : {"before_found", "after_found"}) {
      csv.Cell(cell.value(found, false) ? 1.0 : 0.0);
    }
    csv.EndRow();
  }
  if (experiments.empty() || !(high > low)) return std::nullopt;
  std::string names;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    names += (i == 0 ? "" : ", ") + TicLabel(experiments[i]) + " " + std::to_string(i + 1);
  }
  Figure figure;
  figure.title = "Where the model falls short";
  figure.caption =
      "Excess of the residual over its noise (gap) by signal, band and experiment, before and "
      "after "
      "the best effect: p predicted from measured q (acoustics and both instruments), q from "
      "measured p (delay, flame and both instruments). 0: nothing is left but noise. A dot marks "
      "what is more than noise, at a false discovery rate of 5 % over the map.";
  figure.csv = csv.Text();
  figure.width = 900;
  figure.height = static_cast<int>(2 * (96 + 24 * experiments.size()) + 20);
  const double rows = static_cast<double>(experiments.size());
  Script script;
  script.Line("unset key")
      .Line("unset grid")
      .Line("set logscale x")
      .Line("set xtics (10, 20, 50, 100, 200, 500, 1000, 2000, 5000)")
      .Line("set xrange [" + Number(low) + ":" + Number(high) + "]")
      .Line("set yrange [" + Number(rows + 0.5) + ":0.5]")
      .Line("set ytics noenhanced (" + names + ")")
      .Line("set palette defined (0 '#f7fbff', 0.25 '#9ecae1', 0.5 '#4292c6', 1 '#08306b')")
      .Line("set cbrange [0:" + Number(std::max(top, 1e-3)) + "]")
      .Line("set style fill solid noborder")
      .Line("set multiplot layout 2," + std::string(any_after ? "2" : "1") + " margins 0.08,0.88," +
            Number(64.0 / figure.height) + "," + Number(1.0 - 30.0 / figure.height) +
            " spacing 0.08," + Number(86.0 / figure.height));
  for (const char* signal : {"p", "q"}) {
    for (const bool after : {false, true}) {
      if (after && !any_after) continue;
      const bool last = signal == std::string("p") && (after || !any_after);
      script.Line(last ? "set colorbox user origin 0.905, 0.15 size 0.02, 0.7\nset cblabel 'gap'"
                       : "unset colorbox");
      script.Line("set title '" + std::string(signal) + " from " +
                  (signal == std::string("p") ? "q" : "p") +
                  (after       ? ", best effect in"
                   : any_after ? ", before"
                               : "") +
                  "' offset 0,-0.5");
      script.Line("set xlabel 'frequency (Hz)' offset 0,0.3");
      script.Plot("data using (pick('" + std::string(signal) + "',2)):4:2:3:($4-0.46):($4+0.46):" +
                  (after ? "6" : "5") + " with boxxyerror linecolor palette");
      script.Plot("data using (column(" + std::string(after ? "9" : "8") + ")==1 ? sqrt(pick('" +
                  signal + "',2)*$3) : NaN):4 with points pt 7 ps 0.35 linecolor rgb '#f28e2b'");
      script.EndPlot();
    }
  }
  script.Line("unset multiplot");
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
