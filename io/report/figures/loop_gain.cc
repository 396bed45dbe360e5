// Figure 7 of the paper: the loop's gain at rest over the operating parameter, and where it reaches
// one and the limit cycle vanishes.
#include <cmath>
#include <limits>

#include "estimation/analysis/loop/vanishing_phi.h"
#include "estimation/analysis/spectra/half_width.h"
#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

VanishingPhi Vanishing(const ReportInput& input) {
  std::vector<LoopGainPoint> points;
  for (const MeasuredPoint& point : input.measured) {
    if (point.reliable && std::isfinite(point.loop_gain.value)) {
      points.push_back({point.phi, point.loop_gain});
    }
  }
  return EstimateVanishingPhi(std::span<const LoopGainPoint>(points));
}

}  // namespace

std::optional<Figure> LoopGainFigure(const ReportInput& input) {
  CsvWriter csv("curve,operating_parameter,loop_gain,lo,hi,experiment");
  double low = INFINITY;
  double high = -std::numeric_limits<double>::infinity();
  bool any_interval = false;
  bool any_unreliable = false;
  for (const MeasuredPoint& point : input.measured) {
    if (!std::isfinite(point.loop_gain.value)) continue;
    const double half = HalfWidth95(point.loop_gain);
    any_interval = any_interval || std::isfinite(half);
    any_unreliable = any_unreliable || !point.reliable;
    csv.Cell(point.reliable ? "measured" : "not stationary").Cell(point.phi);
    csv.Cell(point.loop_gain.value).Cell(point.loop_gain.value - half);
    csv.Cell(point.loop_gain.value + half).Cell(point.name).EndRow();
    low = std::min(low, point.phi);
    high = std::max(high, point.phi);
  }
  if (!(low < high)) return std::nullopt;
  const VanishingPhi vanishing = Vanishing(input);
  const double range = high - low;
  // A crossing far away shows only that the gain does not change, so it is stated and not drawn.
  const bool near = vanishing.available && std::isfinite(vanishing.phi) &&
                    vanishing.phi > low - 1.5 * range && vanishing.phi < high + 1.5 * range;
  double left = low - 0.06 * range;
  double right = high + 0.06 * range;
  if (near) {
    left = std::min(left, vanishing.phi - 0.1 * range);
    right = std::max(right, vanishing.phi + 0.1 * range);
  }
  if (vanishing.available) {
    for (const double phi : {left, right}) {
      csv.Cell("line").Cell(phi).Cell(vanishing.intercept + vanishing.slope * phi);
      csv.Cell(NAN).Cell(NAN).Cell("").EndRow();
    }
  }
  if (near) {
    csv.Cell("vanishes").Cell(vanishing.phi).Cell(1.0);
    csv.Cell(std::max(vanishing.lo, left)).Cell(std::min(vanishing.hi, right)).Cell("").EndRow();
  }
  Figure figure;
  figure.title = "Loop gain at the limit cycle";
  figure.caption = "gain · 2π f · |Φ'(0)|, condition (1b): a limit cycle needs more than one";
  figure.caption += any_interval ? ", with 95 % intervals." : ".";
  if (near) {
    figure.caption +=
        " A straight line through the stationary experiments reaches one at " +
        Spelled(vanishing.phi) +
        " (95 %: " + (std::isfinite(vanishing.lo) ? Spelled(vanishing.lo) : "no lower limit") +
        " to " + (std::isfinite(vanishing.hi) ? Spelled(vanishing.hi) : "no upper limit") +
        "; cut at the edges of the figure).";
  } else if (vanishing.available) {
    figure.caption +=
        " A straight line through the stationary experiments does not reach one near them.";
  }
  figure.csv = csv.Text();
  Script script;
  script.Line("set xlabel " + Quoted(input.OperatingLabel()))
      .Line("set ylabel 'loop gain |L Φ′(0)|'")
      .Line("set xrange [" + Number(left) + ":" + Number(right) + "]")
      .Line("set offsets 0, 0, graph 0.12, graph 0.08")
      .Line("set key outside top center horizontal maxcols 2");
  script.Plot("1 with lines linewidth 1 dashtype 3 linecolor rgb '" + std::string(colour::kInk) +
              "' title 'one: the cycle vanishes'");
  if (vanishing.available) {
    script.Plot("data using (pick('line',2)):3 with lines linewidth 1.3 linecolor rgb '" +
                std::string(colour::kSky) + "' title 'straight line'");
  }
  if (near) {
    script.Plot(
        "data using (pick('vanishes',2)):3 with points pointtype 9 pointsize 1 "
        "linewidth 1.3 linecolor rgb '" +
        std::string(colour::kVermillion) + "' title 'line reaches one, 95 %'");
    script.Plot(
        "data using (pick('vanishes',4)):3:($5-$4):(0) with vectors nohead linewidth 1.3 "
        "linecolor rgb '" +
        std::string(colour::kVermillion) + "' notitle");
  }
  script.Plot(
      "data using (pick('measured',2)):3 with points pointtype 3 pointsize 1 linewidth 1.5 "
      "linecolor rgb '" +
      std::string(colour::kBlue) + "' title 'measured'");
  if (any_unreliable) {
    script.Plot(
        "data using (pick('not stationary',2)):3 with points pointtype 6 pointsize 1 "
        "linewidth 1.3 linecolor rgb '" +
        std::string(colour::kBlue) + "' title 'measured, not stationary'");
  }
  if (any_interval) {
    script.Plot(
        "data using (pick('measured',2)):4:(0):($5-$4) with vectors nohead linewidth 1.3 "
        "linecolor rgb '" +
        std::string(colour::kBlue) + "' notitle");
    if (any_unreliable) {
      script.Plot(
          "data using (pick('not stationary',2)):4:(0):($5-$4) with vectors nohead linewidth 1.3 "
          "linecolor rgb '" +
          std::string(colour::kBlue) + "' notitle");
    }
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
