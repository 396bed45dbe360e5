// Figure 9 of the paper: Bode's diagrams of G, one for each experiment, with the measured points.
// The curves are the joint fit's and one member's of the family.
#include <algorithm>
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr int kFrequencies = 120;

}  // namespace

std::optional<Figure> AllBodeFigure(const ReportInput& input) {
  std::vector<const MeasuredPoint*> points;
  for (const MeasuredPoint& point : input.measured) {
    if (point.has_cycle() && input.Fitted(point.name) != nullptr) points.push_back(&point);
  }
  if (points.empty()) return std::nullopt;
  double low = INFINITY;
  double high = 0.0;
  for (const MeasuredPoint* point : points) {
    low = std::min(low, point->frequency_hz.value);
    high = std::max(high, point->frequency_hz.value);
  }
  const std::vector<double> grid = LinearGrid(0.6 * low, 1.5 * high, kFrequencies);
  // In addition to the fit, the member whose omega varies least, by the paper's first qualitative
  // condition.
  std::optional<std::size_t> steady;
  if (input.members) steady = input.members->Thinned(2).front();
  CsvWriter csv("curve,frequency_hz,gain,phase_deg");
  const auto add = [&](const std::string& curve, const LoopModel& model) {
    for (const double frequency : grid) {
      const std::complex<double> value = AcousticsAt(model, frequency);
      csv.Cell(curve).Cell(frequency).Cell(std::abs(value)).Cell(PhaseDeg(value)).EndRow();
    }
  };
  for (const MeasuredPoint* point : points) {
    add(point->name, input.Fitted(point->name)->model);
    const int experiment = steady ? input.members->Experiment(point->name) : -1;
    if (experiment >= 0) {
      add("member " + point->name,
          input.members->models[*steady][static_cast<std::size_t>(experiment)]);
    }
  }
  for (const MeasuredPoint* point : points) {
    csv.Cell("measured " + point->name).Cell(point->frequency_hz.value).Cell(point->gain.value);
    csv.Cell(point->phase_deg.value).EndRow();
  }
  Figure figure;
  figure.title = "Acoustics G at every operating point";
  figure.caption = "Solid: the joint fit, one choice among many" +
                   (steady ? "; dashed: member " + std::to_string(*steady + 1) +
                                 " of the family, whose ω varies least"
                           : std::string()) +
                   "; stars: measured at the limit cycle.";
  figure.csv = csv.Text();
  figure.height = 460;
  Script script;
  script.Line("set xrange [" + Number(grid.front()) + ":" + Number(grid.back()) + "]")
      .Line("set multiplot layout 2,1 margins 0.14,0.78,0.15,0.97 spacing 0,0.06");
  // A long list of names is shared by the two panels.
  const bool split = points.size() > 6;
  for (const bool phase : {false, true}) {
    const std::string column = phase ? "4" : "3";
    if (phase) {
      script.Line("unset logscale y").Line("set format x '%g'").Line("set xlabel 'frequency (Hz)'");
      script.Line("set ylabel 'phase of G (degrees)' offset 1");
      script.Line(split ? "set key at screen 0.99, screen 0.52" : "unset key");
    } else {
      script.Line("set logscale y").Line("set format x ''").Line("set format y '%g'");
      script.Line("set ylabel '|G| (units of p per q)' offset 1");
      script.Line("set key at screen 0.99, screen 0.99 vertical maxrows 20");
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::string colour = SeriesColour(i, points.size());
      const std::string name = points[i]->name;
      if (steady) {
        script.Plot("data using (pick(" + Quoted("member " + name) + ",2)):" + column +
                    " with lines linewidth 0.9 dashtype 2 linecolor rgb '" + colour + "' notitle");
      }
      script.Plot(
          "data using (pick(" + Quoted(name) + ",2)):" + column +
          " with lines linewidth 1.3 linecolor rgb '" + colour + "' " +
          (phase == (split && i >= points.size() / 2) ? "title " + Quoted(name) : "notitle"));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      script.Plot("data using (pick(" + Quoted("measured " + points[i]->name) + ",2)):" + column +
                  " with points pointtype 3 pointsize 1.2 linewidth 1.8 linecolor rgb '" +
                  SeriesColour(i, points.size()) + "' " +
                  (i == 0 && !phase ? "title 'measured'" : "notitle"));
    }
    script.EndPlot();
  }
  script.Line("unset multiplot");
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
