// A campaign's quantities over its rigs: for each rig one bar over all its experiments, pale what
// the family is guaranteed to lie within, dark what was fitted or measured.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "io/report/figures/catalogue.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

struct QuantityPanel {
  const char* quantity;
  const char* label;
  double scale;
};

// The first four that the campaign has.
constexpr QuantityPanel kQuantityPanels[] = {{"omega_hz", "ω (Hz)", 1.0},
                                             {"xi", "ξ", 1.0},
                                             {"tau_s", "τ (ms)", 1e3},
                                             {"loop_gain", "loop gain", 1.0},
                                             {"frequency_hz", "cycle (Hz)", 1.0},
                                             {"phase_deg", "q to p (deg)", 1.0},
                                             {"gain", "gain p/q", 1.0},
                                             {"loop_gain_measured", "loop gain", 1.0}};
constexpr std::size_t kMostPanels = 4;

struct Span {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  void Take(double value) {
    if (!std::isfinite(value)) return;
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  bool IsEmpty() const { return !(lo <= hi); }
};

struct Bar {
  Span guaranteed;
  Span found;
};

using Bars = std::map<std::size_t, Bar>;  // by the rig's place, from 1

std::map<std::string, Bars> BarsByQuantity(const CsvTable& points) {
  std::map<std::string, std::size_t> places;
  std::map<std::string, Bars> bars;
  for (std::size_t row = 0; row < points.rows.size(); ++row) {
    const std::string rig = points.Text(row, "rig");
    const std::size_t place = places.try_emplace(rig, places.size() + 1).first->second;
    Bar& bar = bars[points.Text(row, "quantity")][place];
    bar.found.Take(points.Number(row, "value"));
    bar.guaranteed.Take(points.Number(row, "outer_lo"));
    bar.guaranteed.Take(points.Number(row, "outer_hi"));
  }
  return bars;
}

void AddRows(const QuantityPanel& panel, const Bars& bars, CsvWriter& csv) {
  for (const auto& [place, bar] : bars) {
    const auto scaled = [&](const Span& span, double end) {
      return span.IsEmpty() ? NAN : panel.scale * end;
    };
    csv.Cell(panel.quantity).Cell(static_cast<double>(place));
    csv.Cell(scaled(bar.guaranteed, bar.guaranteed.lo));
    csv.Cell(scaled(bar.guaranteed, bar.guaranteed.hi));
    csv.Cell(scaled(bar.found, bar.found.lo)).Cell(scaled(bar.found, bar.found.hi));
    csv.EndRow();
  }
}

std::string BarPlot(const QuantityPanel& panel, int first_column, const char* colour,
                    double width) {
  const std::string lo = std::to_string(first_column);
  const std::string hi = std::to_string(first_column + 1);
  return "data using (pick('" + std::string(panel.quantity) + "',2)):" + lo + ":(0):($" + hi +
         "-$" + lo + ") with vectors nohead linewidth " + Number(width) + " linecolor rgb '" +
         colour + "'";
}

}  // namespace

std::optional<Figure> CampaignQuantitiesFigure(const ReportInput& input) {
  if (!input.campaign_points) return std::nullopt;
  const std::map<std::string, Bars> bars = BarsByQuantity(*input.campaign_points);
  std::vector<const QuantityPanel*> panels;
  CsvWriter csv("curve,rig,outer_lo,outer_hi,value_lo,value_hi");
  std::size_t rigs = 0;
  for (const QuantityPanel& panel : kQuantityPanels) {
    const auto found = bars.find(panel.quantity);
    if (found == bars.end() || panels.size() == kMostPanels) continue;
    panels.push_back(&panel);
    AddRows(panel, found->second, csv);
    rigs = std::max(rigs, found->second.rbegin()->first);
  }
  if (panels.empty()) return std::nullopt;
  Figure figure;
  figure.title = "The rigs side by side";
  figure.caption =
      "One bar a rig, in the order of the table, over all its experiments: dark, what was fitted "
      "or "
      "measured; pale, what the family is guaranteed to lie within.";
  figure.csv = csv.Text();
  figure.width = 900;
  figure.height = 560;
  const double width = std::clamp(500.0 / static_cast<double>(rigs), 0.6, 9.0);
  Script script;
  script.Line("set multiplot layout 2,2 margins 0.10,0.98,0.10,0.98 spacing 0.12,0.12")
      .Line("unset key")
      .Line("set xrange [0.4:" + Number(static_cast<double>(rigs) + 0.6) + "]")
      .Line("set xlabel 'rig'");
  for (const QuantityPanel* panel : panels) {
    script.Line("set ylabel '" + std::string(panel->label) + "'")
        .Plot(BarPlot(*panel, 3, colour::kSky, width))
        .Plot(BarPlot(*panel, 5, colour::kBlue, 0.6 * width))
        .Plot("data using (pick('" + std::string(panel->quantity) +
              "',2)):5 with points pointtype 7 pointsize " + Number(std::min(0.05 * width, 0.4)) +
              " linecolor rgb '" + colour::kBlue + "'")
        .EndPlot();
  }
  script.Line("unset multiplot");
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
