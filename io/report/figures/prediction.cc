// What `howl predict` says over the operating parameter: frequency and growth rate, with the
// interval that holds 95 % of the members, beside the measured points.
#include <algorithm>
#include <cmath>
#include <vector>

#include "io/report/figures/catalogue.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {

std::optional<Figure> PredictionFigure(const ReportInput& input) {
  std::vector<const nlohmann::json*> points;
  bool any_growth = false;
  for (const auto& point : ListAt(input.prediction, "points")) {
    if (!std::isfinite(NumberAt(JsonAt(point, "frequency_hz"), "value"))) continue;
    points.push_back(&point);
    any_growth = any_growth || std::isfinite(NumberAt(JsonAt(point, "growth_rate_1_s"), "value"));
  }
  if (points.size() < 3) return std::nullopt;  // a table says as much
  std::ranges::stable_sort(points, {}, [](const auto* point) { return NumberAt(*point, "phi"); });
  CsvWriter csv("curve,phi,frequency_hz,frequency_lo,frequency_hi,growth_1_s,growth_lo,growth_hi");
  for (const nlohmann::json* const point : points) {
    csv.Cell("prediction").Cell(NumberAt(*point, "phi"));
    for (const char* const quantity : {"frequency_hz", "growth_rate_1_s"}) {
      for (const char* const key : {"value", "lo", "hi"}) {
        csv.Cell(NumberAt(JsonAt(*point, quantity), key));
      }
    }
    csv.EndRow();
  }
  for (const MeasuredPoint& point : input.measured) {
    if (!point.has_cycle()) continue;
    csv.Cell("measured").Cell(point.phi).Cell(point.frequency_hz.value);
    for (int k = 0; k < 5; ++k) csv.Cell("");
    csv.EndRow();
  }
  Figure figure;
  // A loop that was fitted to whole records has no family.
  const bool of_records = NumberAt(input.prediction, "members") == 0.0;
  figure.title = of_records ? "What the loop does over the operating parameter"
                            : "What the members do over the operating parameter";
  figure.caption =
      std::string(of_records ? "Median and the interval that holds 95 %: "
                             : "Median of the members and the interval that holds 95 % of them: ") +
      "the frequency at which the "
      "loop closes, and the growth rate at rest, above zero where the cycle grows by itself. "
      "Points: measured cycles. Nothing is guaranteed between them.";
  figure.csv = csv.Text();
  figure.height = 420;
  const auto panel = [&](Script& script, const std::string& label, int column) {
    const std::string lo = std::to_string(column + 1), hi = std::to_string(column + 2);
    script.Line("set ylabel '" + label + "'");
    script.Plot("data using (pick('prediction',2)):" + lo + ":" + hi +
                " with filledcurves linecolor rgb '" + colour::kSky + "' title '" +
                (of_records ? "95 %" : "95 % of the members") + "'");
    script.Plot("data using (pick('prediction',2)):" + std::to_string(column) +
                " with linespoints pointtype 7 pointsize 0.3 linewidth 1.5 linecolor rgb '" +
                colour::kBlue + "' title 'median'");
  };
  double left = NumberAt(*points.front(), "phi"), right = NumberAt(*points.back(), "phi");
  for (const MeasuredPoint& point : input.measured) {
    if (!point.has_cycle()) continue;
    left = std::min(left, point.phi);
    right = std::max(right, point.phi);
  }
  const double margin = 0.03 * (right - left);
  Script script;
  script.Line("set key above").Line("set lmargin 9");
  script.Line("set xrange [" + Number(left - margin) + ":" + Number(right + margin) + "]");
  if (any_growth) script.Line("set multiplot layout 2,1").Line("set xlabel ''");
  if (!any_growth) script.Line("set xlabel " + Quoted(input.OperatingLabel()));
  panel(script, "frequency (Hz)", 3);
  script.Plot("data using (pick('measured',2)):3 with points pointtype 6 linecolor rgb '" +
              std::string(colour::kVermillion) + "' title 'measured'");
  script.EndPlot();
  if (any_growth) {
    script.Line("unset key").Line("set xlabel " + Quoted(input.OperatingLabel()));
    panel(script, "growth rate (1/s)", 6);
    script.Plot("0 with lines linewidth 1 dashtype 3 linecolor rgb '" + std::string(colour::kInk) +
                "'");
    script.EndPlot();
    script.Line("unset multiplot");
  }
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
