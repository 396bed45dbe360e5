// Figure 14 of the paper: the delay's phase for three values of tau, about the fitted one. It
// decides where the loop closes a second time.
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"
#include "model/loop/crossings.h"
#include "model/loop/sensitivity.h"

namespace howl {
namespace {

constexpr double kDelayStep = 0.03;  // the paper's 3.37, 3.47 and 3.57 ms

// The crossing above the fundamental with the largest gain.
std::optional<PhaseCrossing> SecondCrossing(const LoopModel& model, double slope, double f) {
  std::optional<PhaseCrossing> best;
  for (const PhaseCrossing& crossing : PhaseCrossings(model.Loop(), slope, 5.0 * f)) {
    if (crossing.frequency_hz > 1.5 * f && (!best || crossing.gain > best->gain)) best = crossing;
  }
  return best;
}

}  // namespace

std::optional<Figure> DelaySensitivityFigure(const ReportInput& input) {
  const MeasuredPoint* reference = input.Reference();
  if (reference == nullptr || input.Fitted(reference->name) == nullptr) return std::nullopt;
  const LoopModel base = input.Fitted(reference->name)->model;
  const double f = reference->frequency_hz.value;
  const double max_hz = ShownFrequencyMax(f);
  CsvWriter csv("curve,frequency_hz,phase_deg");
  std::vector<std::string> names;
  for (const double factor : {1.0 - kDelayStep, 1.0, 1.0 + kDelayStep}) {
    char name[32];
    std::snprintf(name, sizeof name, "τ = %.3f ms", 1e3 * base.tau_s * factor);
    names.emplace_back(name);
    for (const double frequency : {0.0, max_hz}) {
      csv.Cell(names.back()).Cell(frequency).Cell(-360.0 * frequency * base.tau_s * factor);
      csv.EndRow();
    }
  }
  Figure figure;
  figure.title = "How τ moves the delay's phase, " + reference->name;
  figure.caption = "Phase of e^(−sτ) for the fitted τ and 3 % to either side.";
  const auto crossing = SecondCrossing(base, DrawnSlope(*reference, base), f);
  if (crossing) {
    const LoopSensitivity sensitivity = LoopSensitivityAt(base.Loop(), crossing->frequency_hz);
    char text[240];
    std::snprintf(
        text, sizeof text,
        " Dashed: where the fitted loop closes again, %.0f Hz. One per cent of τ moves "
        "the phase there by %.1f° and the crossing by %.1f Hz; one per cent of ω by "
        "%.2f° and %.2f Hz.",
        crossing->frequency_hz,
        std::abs(sensitivity[LoopParameter::kTau].phase_deg) * 0.01 * base.tau_s,
        std::abs(sensitivity.CrossingShiftHz(LoopParameter::kTau)) * 0.01 * base.tau_s,
        std::abs(sensitivity[LoopParameter::kOmega].phase_deg) * 0.01 * base.omega_hz,
        std::abs(sensitivity.CrossingShiftHz(LoopParameter::kOmega)) * 0.01 * base.omega_hz);
    figure.caption += text;
    for (const double phase : {0.0, -360.0 * max_hz * base.tau_s * (1.0 + kDelayStep)}) {
      csv.Cell("second crossing").Cell(crossing->frequency_hz).Cell(phase).EndRow();
    }
  }
  figure.csv = csv.Text();
  Script script;
  script.Line("set xlabel 'frequency (Hz)'")
      .Line("set ylabel 'phase of the delay (degrees)'")
      .Line("set ytics 180")
      .Line("set key bottom left")
      .Line("set xrange [0:" + Number(max_hz) + "]");
  for (std::size_t i = 0; i < names.size(); ++i) {
    script.Plot("data using (pick(" + Quoted(names[i]) +
                ",2)):3 with lines linewidth 1.4 dashtype " + (i == 1 ? "1" : "2") +
                " linecolor rgb '" + SeriesColour(i, 3) + "' title " + Quoted(names[i]));
  }
  if (crossing) {
    script.Plot(
        "data using (pick('second crossing',2)):3 with lines linewidth 1 dashtype 3 "
        "linecolor rgb '" +
        std::string(colour::kInk) + "' title 'loop closes again'");
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
