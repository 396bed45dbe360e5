// Figure 4 of the paper: the delay of (3) with the period of the limit cycle.
#include <cmath>

#include "estimation/analysis/spectra/half_width.h"
#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {

std::optional<Figure> DelayFigure(const ReportInput& input) {
  CsvWriter csv("curve,operating_parameter,ms,lo_ms,hi_ms,experiment");
  int count = 0;
  bool any_interval = false;
  bool any_unreliable = false;
  for (const MeasuredPoint& point : input.measured) {
    if (!point.has_cycle() || !std::isfinite(point.tau_s.value)) continue;
    ++count;
    const double half = HalfWidth95(point.tau_s);
    any_interval = any_interval || std::isfinite(half);
    any_unreliable = any_unreliable || !point.reliable;
    csv.Cell(point.reliable ? "delay" : "delay (not stationary)").Cell(point.phi);
    csv.Cell(1e3 * point.tau_s.value).Cell(1e3 * (point.tau_s.value - half));
    csv.Cell(1e3 * (point.tau_s.value + half)).Cell(point.name).EndRow();
    csv.Cell("period").Cell(point.phi).Cell(1e3 / point.frequency_hz.value).Cell(NAN).Cell(NAN);
    csv.Cell(point.name).EndRow();
  }
  if (count == 0) return std::nullopt;
  for (const ExperimentModel& fit : input.fitted) {
    csv.Cell("fit").Cell(fit.phi).Cell(1e3 * fit.model.tau_s).Cell(NAN).Cell(NAN);
    csv.Cell(fit.name).EndRow();
  }
  const bool has_bounds = input.family.contains("bounds") && input.members.has_value();
  if (has_bounds) {
    for (std::size_t i = 0; i < input.members->experiments.size(); ++i) {
      const auto& bounds = input.family["bounds"];
      const std::string& name = input.members->experiments[i];
      if (!bounds.contains(name) || !bounds[name].contains("tau_s")) continue;
      const auto& outer = bounds[name]["tau_s"]["outer"];
      csv.Cell("family").Cell(input.members->phi[i]).Cell(NAN);
      csv.Cell(1e3 * outer.at(0).get<double>()).Cell(1e3 * outer.at(1).get<double>()).Cell(name);
      csv.EndRow();
    }
  }
  Figure figure;
  figure.title = "Delay, beside the period of the limit cycle";
  figure.caption = "The delay τ from the q-to-p phase, equation (3)" +
                   std::string(any_interval ? ", with 95 % intervals" : "") +
                   (input.fitted.empty() ? "" : "; crosses: the joint fit") +
                   (has_bounds ? "; bars: guaranteed bounds of the family" : "") +
                   ". A delay that keeps its value while the period moves is one of transport.";
  figure.csv = csv.Text();
  Script script;
  script.Line("set xlabel " + Quoted(input.OperatingLabel()))
      .Line("set ylabel 'ms'")
      .Line("set key outside top center horizontal maxcols 3")
      .Line("set offsets graph 0.04, graph 0.04, graph 0.08, graph 0.08");
  if (has_bounds) {
    script.Plot(
        "data using (pick('family',2)):4:(0):($5-$4) with vectors nohead linewidth 13 "
        "linecolor rgb '" +
        std::string(colour::kSky) + "' title 'τ, family'");
  }
  script.Plot(
      "data using (pick('period',2)):3 with linespoints pointtype 4 pointsize 0.7 "
      "linewidth 1 dashtype 2 linecolor rgb '" +
      std::string(colour::kGrey) + "' title 'period 1/f'");
  script.Plot(
      "data using (pick('delay',2)):3 with points pointtype 7 pointsize 0.8 linecolor rgb '" +
      std::string(colour::kBlue) + "' title 'τ measured'");
  if (any_interval) {
    script.Plot(
        "data using (pick('delay',2)):4:(0):($5-$4) with vectors nohead linewidth 1.3 "
        "linecolor rgb '" +
        std::string(colour::kBlue) + "' notitle");
  }
  if (any_unreliable) {
    script.Plot(
        "data using (pick('delay (not stationary)',2)):3 with points pointtype 6 "
        "pointsize 0.9 linecolor rgb '" +
        std::string(colour::kBlue) + "' title 'τ, not stationary'");
    if (any_interval) {
      script.Plot(
          "data using (pick('delay (not stationary)',2)):4:(0):($5-$4) with vectors nohead "
          "linewidth 1.3 "
          "linecolor rgb '" +
          std::string(colour::kBlue) + "' notitle");
    }
  }
  if (!input.fitted.empty()) {
    script.Plot(
        "data using (pick('fit',2)):3 with points pointtype 2 pointsize 0.8 linewidth 1.5 "
        "linecolor rgb '" +
        std::string(colour::kVermillion) + "' title 'τ of the fit'");
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
