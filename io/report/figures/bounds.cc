// Guaranteed bounds of the family as bars: no member lies outside the pale bar, and members were
// found at both ends of the dark one. The joint fit is one choice within.
#include <cmath>
#include <limits>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

struct Panel {
  const char* key;
  const char* label;
  double scale;
};

constexpr Panel kPanels[] = {{"omega_hz", "ω (Hz)", 1.0},      {"xi", "ξ", 1.0},
                             {"N", "N (10³ p/q rad/s)", 1e-3}, {"M", "M (10³ p/q rad/s)", 1e-3},
                             {"tau_s", "τ (ms)", 1e3},         {"loop_gain", "loop gain", 1.0}};

// A round step that puts four or five ticks on the range.
double TickStep(double range) {
  const double raw = range / 4.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= raw) return step * power;
  }
  return 10.0 * power;
}

double Fitted(const ReportInput& input, const std::string& experiment, const std::string& key) {
  const ExperimentModel* fit = input.Fitted(experiment);
  if (fit == nullptr) return NAN;
  if (key == "omega_hz") return fit->model.omega_hz;
  if (key == "xi") return fit->model.xi;
  if (key == "N") return fit->model.N;
  if (key == "M") return fit->model.M;
  if (key == "tau_s") return fit->model.tau_s;
  for (const auto& row : input.solution["experiments"]) {
    if (row.value("name", "") == experiment) return NumberAt(row, "loop_gain");
  }
  return NAN;
}

}  // namespace

std::optional<Figure> BoundsFigure(const ReportInput& input) {
  if (!input.family.contains("bounds") || !input.family["bounds"].is_object()) return std::nullopt;
  const auto& bounds = input.family["bounds"];
  std::vector<std::string> experiments;
  if (input.members) {
    experiments = input.members->experiments;
  } else {
    for (const auto& [name, value] : bounds.items()) experiments.push_back(name);
  }
  CsvWriter csv("curve,row,outer_lo,outer_hi,inner_lo,inner_hi,fit,experiment");
  std::vector<const Panel*> panels;
  std::vector<double> steps;
  std::vector<std::string> ranges;
  bool any_fit = false;
  for (const Panel& panel : kPanels) {
    bool any = false;
    double low = INFINITY;
    double high = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < experiments.size(); ++i) {
      if (!bounds.contains(experiments[i]) || !bounds[experiments[i]].contains(panel.key)) continue;
      const auto& each = bounds[experiments[i]][panel.key];
      const auto end = [&](const char* kind, std::size_t side) {
        const bool there = each.contains(kind) && each[kind].is_array() && each[kind].size() == 2 &&
                           each[kind][side].is_number();
        return there ? panel.scale * each[kind][side].get<double>() : NAN;
      };
      if (std::isnan(end("outer", 0))) continue;
      any = any || end("outer", 1) > 0.0;
      low = std::min(low, end("outer", 0));
      high = std::max(high, end("outer", 1));
      csv.Cell(panel.key).Cell(static_cast<double>(i + 1));
      csv.Cell(end("outer", 0)).Cell(end("outer", 1)).Cell(end("inner", 0)).Cell(end("inner", 1));
      const double fitted = panel.scale * Fitted(input, experiments[i], panel.key);
      any_fit = any_fit || std::isfinite(fitted);
      csv.Cell(fitted).Cell(experiments[i]);
      csv.EndRow();
    }
    if (!any) continue;
    panels.push_back(&panel);
    steps.push_back(TickStep(std::max(high - low, 1e-9)));
    const double margin = 0.04 * std::max(high - low, 1e-9);
    ranges.push_back("[" + Number(low > 0.0 ? low - margin : low) + ":" + Number(high + margin) +
                     "]");
  }
  if (panels.empty()) return std::nullopt;
  const auto count = static_cast<double>(experiments.size());
  const int rows = static_cast<int>((panels.size() + 2) / 3);
  Figure figure;
  figure.title = "Guaranteed bounds of the family";
  figure.caption =
      "No model that passes the test lies outside the pale bars; members were found at both ends "
      "of the dark ones.";
  if (any_fit) figure.caption += " Crosses: the joint fit.";
  figure.csv = csv.Text();
  figure.width = 900;
  figure.height = static_cast<int>(rows * (70.0 + 20.0 * count) + 20);
  Script script;
  std::string names;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    names += (i == 0 ? "" : ", ") + TicLabel(experiments[i]) + " " + std::to_string(i + 1);
  }
  script
      .Line("set multiplot layout " + std::to_string(rows) + ",3 margins 0.07,0.98," +
            Number(50.0 / figure.height) + "," + Number(1.0 - 12.0 / figure.height) +
            " spacing 0.07," + Number(58.0 / figure.height))
      .Line("unset key")
      .Line("set ytics noenhanced (" + names + ")")
      .Line("set yrange [" + Number(count + 0.6) + ":0.4]")
      .Line("set style fill solid noborder");
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Panel* panel = panels[i];
    script.Line("set xtics " + Number(steps[i]));
    const std::string pick = "(pick('" + std::string(panel->key) + "',";
    script.Line("set xlabel '" + std::string(panel->label) + "' offset 0,0.4");
    script.Line("set xrange " + ranges[i]);
    script.Plot("data using " + pick +
                "3)):2:3:4:($2-0.36):($2+0.36) with boxxyerror linecolor rgb '" +
                std::string(colour::kSky) + "'");
    script.Plot("data using " + pick +
                "5)):2:5:6:($2-0.22):($2+0.22) with boxxyerror linecolor rgb '" +
                std::string(colour::kBlue) + "'");
    script.Plot("data using " + pick +
                "7)):2 with points pointtype 2 pointsize 0.9 linewidth 2 "
                "linecolor rgb '" +
                std::string(colour::kInk) + "'");
    script.EndPlot();
  }
  script.Line("unset multiplot");
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
