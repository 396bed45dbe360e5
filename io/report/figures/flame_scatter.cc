// Figure 5 of the paper: q against the delayed derivative of p in one experiment, and the
// characteristic that bin means make of the cloud.
#include <cmath>

#include "estimation/analysis/flame/flame_curve.h"
#include "estimation/analysis/flame/flame_regressor.h"
#include "estimation/analysis/spectra/half_width.h"
#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/report/spelled_interval.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr int kMostSamples = 1200;

}  // namespace

std::optional<Figure> FlameScatterFigure(const ReportInput& input) {
  const auto shown = ReferenceRecord(input);
  if (!shown || shown->record->record.heat_release.empty()) return std::nullopt;
  const Record& record = shown->record->record;
  Analysis analysis = AnalyseRecord(record, {}, shown->record->cycle_hz);
  if (analysis.characteristics.state == CycleState::kNoLimitCycle) return std::nullopt;
  const MeasuredPoint* point = input.Measured(shown->record->name);
  Estimate tau = point != nullptr ? point->tau_s : Estimate{};
  if (shown->simulated || !std::isfinite(tau.value)) {
    tau = DelayOnBranch({analysis.characteristics.frequency_hz, analysis.characteristics.phase_deg},
                        0);
  }
  AddFlame(record, tau, {}, &analysis);
  const FlameCurve& curve = *analysis.flame_curve;
  const FlameRegressor regressor(record, analysis.characteristics, tau.value, 1);

  CsvWriter csv("curve,delayed_derivative,q,q_std");
  const int step = std::max(1, (regressor.last() - regressor.first()) / kMostSamples);
  for (int i = regressor.first(); i < regressor.last(); i += step) {
    csv.Cell("samples").Cell(regressor.Fundamental(i).real());
    csv.Cell(record.heat_release[static_cast<std::size_t>(i)]).Cell(NAN).EndRow();
  }
  for (const FlameCurveBin& bin : curve.bins) {
    csv.Cell("bin means").Cell(bin.x).Cell(bin.q).Cell(bin.q_std).EndRow();
  }
  for (const double share : {-0.45, 0.45}) {
    csv.Cell("slope").Cell(share * curve.x_amplitude);
    csv.Cell(curve.offset.value + share * curve.x_amplitude * curve.slope.value).Cell(NAN).EndRow();
  }
  Figure figure;
  figure.title = std::string(shown->simulated ? "Flame, simulated record of " : "Flame, ") +
                 shown->record->name;
  figure.caption =
      "Heat release against the delayed derivative of pressure, (4) with the fundamental alone; "
      "the characteristic is the mean of q in bins. Slope at zero " +
      SpelledInterval(curve.slope) + (std::isfinite(curve.slope.std) ? " (95 %)." : ".") +
      (shown->simulated ? " Simulated: no measured record is at hand." +
                              SimulationRemark(input, shown->record->name)
                        : "");
  figure.csv = csv.Text();
  Script script;
  script.Line("set xlabel 'delayed derivative of p (units of p per second)'")
      .Line("set format x '%.1s%c'")
      .Line("set ylabel 'q (units of the record)'")
      .Line("set key top right")
      .Plot(
          "data using (pick('samples',2)):3 with points pointtype 7 pointsize 0.2 linecolor rgb '" +
          std::string(colour::kGrey) + "' title 'samples'")
      .Plot("data using (pick('slope',2)):3 with lines linewidth 1.2 dashtype 2 linecolor rgb '" +
            std::string(colour::kVermillion) + "' title 'slope at zero'")
      .Plot(
          "data using (pick('bin means',2)):3 with linespoints pointtype 7 pointsize 0.4 "
          "linewidth 1.5 linecolor rgb '" +
          std::string(colour::kBlue) + "' title 'bin means'")
      .EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
