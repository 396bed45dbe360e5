// Figure 10 of the paper: harmonic and non-harmonic lines over the operating parameter, and where
// the model's loop closes a second time.
#include <cmath>

#include "estimation/analysis/spectra/half_width.h"
#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"
#include "model/loop/crossings.h"

namespace howl {
namespace {

constexpr int kHarmonics = 4;

}  // namespace

std::optional<Figure> LinesFigure(const ReportInput& input) {
  CsvWriter csv("curve,operating_parameter,frequency_hz,lo_hz,hi_hz,experiment");
  double top = 0.0;
  std::vector<const MeasuredPoint*> points;
  for (const MeasuredPoint& point : input.measured) {
    if (point.has_cycle()) points.push_back(&point);
  }
  if (points.size() < 2) return std::nullopt;
  for (int harmonic = 1; harmonic <= kHarmonics; ++harmonic) {
    for (const MeasuredPoint* point : points) {
      csv.Cell("harmonic " + std::to_string(harmonic)).Cell(point->phi);
      csv.Cell(harmonic * point->frequency_hz.value).Cell(NAN).Cell(NAN).Cell(point->name);
      csv.EndRow();
      top = std::max(top, harmonic * point->frequency_hz.value);
    }
  }
  top *= 1.15;
  bool any_line = false;
  double line_sum_hz = 0.0;
  int line_count = 0;
  for (const MeasuredLine& line : input.lines) {
    if (line.harmonic != 0 || line.frequency_hz.value > top) continue;
    const double half = std::isfinite(line.frequency_hz.std) ? HalfWidth95(line.frequency_hz) : 0.0;
    csv.Cell("non-harmonic").Cell(line.phi).Cell(line.frequency_hz.value);
    csv.Cell(line.frequency_hz.value - half).Cell(line.frequency_hz.value + half);
    csv.Cell(line.experiment).EndRow();
    any_line = true;
    line_sum_hz += line.frequency_hz.value;
    ++line_count;
  }
  const double mean_line_hz = line_sum_hz / std::max(line_count, 1);
  // Of the loop's further phase crossings the one nearest to the observed lines, or without any the
  // one with the largest gain.
  bool any_crossing = false;
  for (const MeasuredPoint* point : points) {
    const ExperimentModel* fit = input.Fitted(point->name);
    if (fit == nullptr || fit->model.M <= 0.0) continue;
    const PhaseCrossing* best = nullptr;
    const auto crossings = PhaseCrossings(fit->model.Loop(), DrawnSlope(*point, fit->model), top);
    for (const PhaseCrossing& crossing : crossings) {
      if (crossing.frequency_hz < 1.5 * point->frequency_hz.value) continue;
      const auto better = [&] {
        if (any_line) {
          return std::abs(crossing.frequency_hz - mean_line_hz) <
                 std::abs(best->frequency_hz - mean_line_hz);
        }
        return crossing.gain > best->gain;
      };
      if (best == nullptr || better()) best = &crossing;
    }
    if (best == nullptr) continue;
    csv.Cell("second crossing").Cell(point->phi).Cell(best->frequency_hz).Cell(NAN).Cell(NAN);
    csv.Cell(point->name).EndRow();
    any_crossing = true;
  }
  Figure figure;
  figure.title = "Harmonic and non-harmonic lines over the operating parameter";
  figure.caption =
      "Multiples of the measured limit-cycle frequency" +
      std::string(any_line ? ", and the observed lines that are none (95 % intervals)" : "") +
      (any_crossing ? "; crosses: where the fitted loop's phase is 180 degrees a second time"
                    : "") +
      ". A line that does not follow the harmonics has a cause of its own.";
  figure.csv = csv.Text();
  Script script;
  script.Line("set xlabel " + Quoted(input.OperatingLabel()))
      .Line("set ylabel 'frequency (Hz)'")
      .Line("set yrange [0:" + Number(top) + "]")
      .Line("set offsets graph 0.04, graph 0.04, 0, 0")
      .Line("set key outside top center horizontal maxcols 4");
  for (int harmonic = kHarmonics; harmonic >= 1; --harmonic) {
    script.Plot("data using (pick('harmonic " + std::to_string(harmonic) +
                "',2)):3 with linespoints pointsize 0.6 linewidth 1 pointtype " +
                std::to_string(SeriesPoint(static_cast<std::size_t>(harmonic - 1))) +
                " linecolor rgb '" + (harmonic == 1 ? colour::kBlue : colour::kSky) + "' title '" +
                (harmonic == 1 ? "f" : std::to_string(harmonic) + " f") + "'");
  }
  if (any_line) {
    script.Plot(
        "data using (pick('non-harmonic',2)):3 with points pointtype 3 pointsize 0.9 "
        "linewidth 1.4 linecolor rgb '" +
        std::string(colour::kVermillion) + "' title 'non-harmonic'");
    script.Plot(
        "data using (pick('non-harmonic',2)):4:(0):($5-$4) with vectors nohead linewidth 1.3 "
        "linecolor rgb '" +
        std::string(colour::kVermillion) + "' notitle");
  }
  if (any_crossing) {
    script.Plot(
        "data using (pick('second crossing',2)):3 with points pointtype 2 pointsize 1 "
        "linewidth 1.5 linecolor rgb '" +
        std::string(colour::kGreen) + "' title 'loop closes again'");
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
