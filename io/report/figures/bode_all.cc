// Figure 9 of the seed: Bode's diagrams of G, one for each experiment, with the measured points.
// The curves are the joint fit's, and where the family was listed its range over members.
#include <algorithm>
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr int kGridPoints = 120;
constexpr std::size_t kRangeMembers = 400;
constexpr std::size_t kMostRanges = 6;  // more would cover each other

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
  const std::vector<double> grid = LinearGrid(0.6 * low, 1.5 * high, kGridPoints);
  const bool with_range = input.members.has_value() && points.size() <= kMostRanges;
  CsvWriter csv("curve,frequency_hz,gain,phase_deg,gain_lo,gain_hi,phase_lo_deg,phase_hi_deg");
  for (const MeasuredPoint* point : points) {
    const LoopModel& model = input.Fitted(point->name)->model;
    const int experiment = with_range ? input.members->Experiment(point->name) : -1;
    const auto range_members =
        experiment >= 0 ? input.members->Thinned(kRangeMembers) : std::vector<std::size_t>{};
    for (const double frequency : grid) {
      const std::complex<double> value = AcousticsAt(model, frequency);
      double bounds[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
      for (const std::size_t member : range_members) {
        const std::complex<double> other = AcousticsAt(
            input.members->models[member][static_cast<std::size_t>(experiment)], frequency);
        bounds[0] = std::min(bounds[0], std::abs(other));
        bounds[1] = std::max(bounds[1], std::abs(other));
        bounds[2] = std::min(bounds[2], PhaseDeg(other));
        bounds[3] = std::max(bounds[3], PhaseDeg(other));
      }
      csv.Cell(point->name).Cell(frequency).Cell(std::abs(value)).Cell(PhaseDeg(value));
      for (const double bound : bounds) csv.Cell(bound);
      csv.EndRow();
    }
  }
  for (const MeasuredPoint* point : points) {
    csv.Cell("measured " + point->name).Cell(point->frequency_hz.value).Cell(point->gain.value);
    csv.Cell(point->phase_deg.value);
    for (int k = 0; k < 4; ++k) csv.Cell(NAN);
    csv.EndRow();
  }
  Figure figure;
  figure.name = "bode_all";
  figure.seed = "9";
  figure.title = "Acoustics G at every operating point";
  figure.caption = "Lines: the joint fit, one choice among many" +
                   std::string(with_range ? "; shaded: the range over the family's members" : "") +
                   "; stars: measured at the limit cycle.";
  figure.csv = csv.Text();
  figure.height = 560;
  Script script;
  script.Line("set xrange [" + Number(grid.front()) + ":" + Number(grid.back()) + "]")
      .Line("set multiplot layout 2,1 margins 0.12,0.80,0.11,0.97 spacing 0,0.06")
      .Line("set style fill transparent solid 0.10 noborder");
  for (const bool phase : {false, true}) {
    const std::string column = phase ? "4" : "3";
    if (phase) {
      script.Line("unset logscale y").Line("set format x '%g'").Line("set xlabel 'frequency (Hz)'");
      script.Line("set ylabel 'phase of G (degrees)' offset 1").Line("unset key");
    } else {
      script.Line("set logscale y").Line("set format x ''").Line("set format y '%g'");
      script.Line("set ylabel '|G| (units of p per q)' offset 1");
      script.Line("set key at screen 0.99, screen 0.97");
    }
    const std::string bounds = phase ? ":7:8" : ":5:6";
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::string colour = SeriesColour(i, points.size());
      const std::string name = points[i]->name;
      if (with_range) {
        script.Plot("data using (pick(" + Quoted(name) + ",2))" + bounds +
                    " with filledcurves linecolor rgb '" + colour + "' notitle");
      }
      script.Plot("data using (pick(" + Quoted(name) + ",2)):" + column +
                  " with lines linewidth 1.3 linecolor rgb '" + colour + "' title " + Quoted(name));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      script.Plot("data using (pick(" + Quoted("measured " + points[i]->name) + ",2)):" + column +
                  " with points pointtype 3 pointsize 1.2 linewidth 1.8 linecolor rgb '" +
                  SeriesColour(i, points.size()) + "' " +
                  (i == 0 ? "title 'measured'" : "notitle"));
    }
    script.EndPlot();
  }
  script.Line("unset multiplot");
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
