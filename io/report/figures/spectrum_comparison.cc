// Figure 11 of the paper: measured and simulated power spectra of p. Where there is no measured
// record, the simulated one is drawn with the measured frequencies.
#include <cmath>
#include <limits>

#include "estimation/analysis/spectra/spectrum.h"
#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr double kShownDb = 90.0;

}  // namespace

std::optional<Figure> SpectrumComparisonFigure(const ReportInput& input) {
  const MeasuredPoint* reference = input.Reference();
  if (reference == nullptr) return std::nullopt;
  const NamedRecord* simulated = input.SimulatedOf(reference->name);
  if (simulated == nullptr) return std::nullopt;
  const NamedRecord* measured = input.RecordOf(reference->name);
  const double max_hz = std::min(std::max(1000.0, ShownFrequencyMax(reference->frequency_hz.value)),
                                 0.45 * simulated->record.sampling_hz);
  CsvWriter csv("curve,frequency_hz,power_db");
  double top = -std::numeric_limits<double>::infinity();
  const auto add = [&](const char* curve, const Record& record) {
    const CrossSpectrum spectrum = WelchSpectrum(record.pressure, {}, record.sampling_hz);
    for (std::size_t k = 1; k < spectrum.pp.size(); ++k) {
      const double frequency = spectrum.Frequency(static_cast<int>(k));
      if (frequency > max_hz) break;
      const double db = 10.0 * std::log10(std::max(spectrum.pp[k], 1e-300));
      top = std::max(top, db);
      csv.Cell(curve).Cell(frequency).Cell(db).EndRow();
    }
  };
  if (measured != nullptr) add("measured", measured->record);
  add("simulated", simulated->record);
  const double bottom = top - kShownDb;
  const auto mark = [&](const char* curve, double frequency) {
    for (const double db : {bottom, top + 8.0}) csv.Cell(curve).Cell(frequency).Cell(db).EndRow();
  };
  int lines = 0;
  if (measured == nullptr) {
    mark("measured fundamental", reference->frequency_hz.value);
    for (const MeasuredLine& line : input.lines) {
      if (line.experiment != reference->name || line.harmonic != 0) continue;
      mark(("measured line " + std::to_string(++lines)).c_str(), line.frequency_hz.value);
    }
  }
  Figure figure;
  figure.title = "Simulated power spectrum of p, " + reference->name;
  figure.caption = measured != nullptr
                       ? "Measured record and what the loop gives when simulated with noise."
                       : "What the loop gives when simulated with noise; dashed: the "
                         "frequencies that were measured (no measured record is at hand).";
  figure.caption += SimulationRemark(input, reference->name);
  figure.csv = csv.Text();
  Script script;
  script.Line("set xlabel 'frequency (Hz)'")
      .Line("set ylabel 'p (dB re 1 unit²/Hz)'")
      .Line("set xrange [0:" + Number(max_hz) + "]")
      .Line("set yrange [" + Number(bottom) + ":" + Number(top + 8.0) + "]");
  if (measured != nullptr) {
    script.Plot("data using (pick('measured',2)):3 with lines linewidth 1.2 linecolor rgb '" +
                std::string(colour::kBlue) + "' title 'measured'");
  }
  script.Plot("data using (pick('simulated',2)):3 with lines linewidth 1.2 linecolor rgb '" +
              std::string(colour::kVermillion) + "' title 'simulated'");
  if (measured == nullptr) {
    script.Plot(
        "data using (pick('measured fundamental',2)):3 with lines linewidth 1 dashtype 2 "
        "linecolor rgb '" +
        std::string(colour::kBlue) + "' title 'measured limit cycle'");
    for (int k = 1; k <= lines; ++k) {
      script.Plot("data using (pick('measured line " + std::to_string(k) +
                  "',2)):3 with lines linewidth 1 dashtype 3 linecolor rgb '" +
                  std::string(colour::kGreen) +
                  (k == 1 ? "' title 'measured non-harmonic line'" : "' notitle"));
    }
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
