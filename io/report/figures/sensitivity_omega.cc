// Figure 13 of the paper: s G(s) for three values of omega, about the fitted one. Far above the
// third mode gain and phase hardly move.
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr double kFrequencyStep = 0.075;  // the paper's 185, 200 and 215 Hz
constexpr int kSensitivityFrequencies = 240;

}  // namespace

std::optional<Figure> OmegaSensitivityFigure(const ReportInput& input) {
  const MeasuredPoint* reference = input.Reference();
  if (reference == nullptr || input.Fitted(reference->name) == nullptr) return std::nullopt;
  const LoopModel base = input.Fitted(reference->name)->model;
  const double f = reference->frequency_hz.value;
  const std::vector<double> grid =
      LinearGrid(0.25 * f, ShownFrequencyMax(f), kSensitivityFrequencies);
  CsvWriter csv("curve,frequency_hz,gain_db,phase_deg");
  std::vector<std::string> names;
  for (const double factor : {1.0 - kFrequencyStep, 1.0, 1.0 + kFrequencyStep}) {
    LoopModel model = base;
    model.omega_hz *= factor;
    char name[32];
    std::snprintf(name, sizeof name, "ω = %.1f Hz", model.omega_hz);
    names.emplace_back(name);
    for (const double frequency : grid) {
      const std::complex<double> value = RateAt(model, frequency);
      double phase = PhaseDeg(value);
      if (phase < -1.0) phase += 360.0;
      csv.Cell(names.back()).Cell(frequency).Cell(Decibels(std::abs(value))).Cell(phase).EndRow();
    }
  }
  Figure figure;
  figure.title = "How ω moves the oscillators, " + reference->name;
  figure.caption =
      "s G(s), the oscillators with both time derivatives, for the fitted ω and 7.5 % to either "
      "side: " +
      std::string(base.M > 0.0 ? "beyond the second mode" : "well above the mode") +
      " gain and phase hardly depend on it.";
  figure.csv = csv.Text();
  figure.height = 440;
  Script script;
  script.Line("set xrange [" + Number(grid.front()) + ":" + Number(grid.back()) + "]")
      .Line("set multiplot layout 2,1 margins 0.14,0.96,0.15,0.97 spacing 0,0.06");
  for (const bool phase : {false, true}) {
    if (phase) {
      script.Line("set format x '%g'").Line("set xlabel 'frequency (Hz)'").Line("unset key");
      script.Line("set ylabel 'phase (degrees)' offset 1").Line("set yrange [0:185]");
      script.Line("set ytics 45");
    } else {
      script.Line("set key bottom right")
          .Line("set format x ''")
          .Line("set ylabel '|s G| (dB)' offset 1");
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      script.Plot("data using (pick(" + Quoted(names[i]) + ",2)):" + (phase ? "4" : "3") +
                  " with lines linewidth 1.4 dashtype " + (i == 1 ? "1" : "2") +
                  " linecolor rgb '" + SeriesColour(i, 3) + "' title " + Quoted(names[i]));
    }
    script.EndPlot();
  }
  script.Line("unset multiplot");
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
