// The two qualitative conditions of the paper's section 3.3 against each other: omega nearly
// constant over the operating points, and damping small. One member can have less of one only for
// more of the other.
#include <algorithm>
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr std::size_t kPointsDrawn = 800;

}  // namespace

std::optional<Figure> TradeoffFigure(const ReportInput& input) {
  if (!input.tradeoff || !input.tradeoff->Find("omega_spread") || !input.tradeoff->Find("xi_max")) {
    return std::nullopt;
  }
  CsvWriter csv("curve,omega_spread_percent,xi_max,member");
  double right = 0.0;
  double xi_test = NAN;
  double spread_test = NAN;
  if (input.family.contains("test")) {
    xi_test = NumberAt(input.family["test"], "xi_max");
    spread_test = NumberAt(input.family["test"], "omega_spread_max");
  }
  double top = 0.0;
  double members_top = 0.0;
  for (std::size_t row = 0; row < input.tradeoff->rows.size(); ++row) {
    const double spread = input.tradeoff->Number(row, "omega_spread");
    csv.Cell("trade-off").Cell(100.0 * spread).Cell(input.tradeoff->Number(row, "xi_max"));
    csv.Cell("").EndRow();
    right = std::max(right, 100.0 * spread);
    top = std::max(top, input.tradeoff->Number(row, "xi_max"));
  }
  if (input.members) {
    for (const std::size_t member : input.members->Thinned(kPointsDrawn)) {
      csv.Cell("members").Cell(100.0 * input.members->omega_spread[member]);
      csv.Cell(input.members->xi_max[member]).Cell(static_cast<double>(member + 1)).EndRow();
    }
    members_top = std::ranges::max(input.members->xi_max);
    right = std::max(right, 100.0 * std::ranges::max(input.members->omega_spread));
  }
  // Every member and the test's limit are inside. The curve runs away where omega is held constant
  // and may leave: the test's region is what matters.
  const double region = std::max(members_top, std::isfinite(xi_test) ? xi_test : 0.0);
  if (region > 0.0) top = std::clamp(top, region, 3.0 * region);
  Figure figure;
  figure.title = "Trade-off between constant ω and small damping";
  // With two modes the curve is what a search found, not a bound.
  const bool bound = !input.config || input.config->model.modes == 1;
  figure.caption = std::string("The smallest largest-ξ that any model ") +
                   (bound ? "has" : "was found to have") +
                   " at each spread of ω over the operating points" +
                   (bound ? "; nothing below the line is compatible with the data" : "") +
                   (input.members ? "; dots: members of the family" : "") + ".";
  figure.csv = csv.Text();
  Script script;
  script.Line("set xlabel 'spread of ω over the operating points, max/min − 1 (%)'")
      .Line("set key bottom left")
      .Line("set ylabel 'largest damping ratio ξ'")
      .Line("set xrange [0:" + Number(right * 1.03) + "]")
      .Line("set yrange [0:" + Number(top * 1.05) + "]");
  if (input.members) {
    script.Plot(
        "data using (pick('members',2)):3 with points pointtype 7 pointsize 0.25 linecolor "
        "rgb '" +
        std::string(colour::kSky) + "' title 'members'");
  }
  if (std::isfinite(xi_test)) {
    script.Plot(Number(xi_test) + " with lines linewidth 1 dashtype 3 linecolor rgb '" +
                std::string(colour::kInk) + "' title 'limits of the test'");
  }
  script.Plot("data using (pick('trade-off',2)):3 with lines linewidth 2 linecolor rgb '" +
              std::string(colour::kVermillion) + "' title 'trade-off'");
  script.EndPlot();
  figure.script = script.Text();
  if (std::isfinite(spread_test) && 100.0 * spread_test < right * 1.03) {
    const std::string x = Number(100.0 * spread_test);
    figure.script = "set arrow from " + x + ", graph 0 to " + x +
                    ", graph 1 nohead linewidth 1 dashtype 3 linecolor rgb '" + colour::kInk +
                    "'\n" + figure.script;
  }
  return figure;
}

}  // namespace howl
