// Figure 2 of the paper: power spectra of p and q, with every line named.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "estimation/analysis/spectra/lines.h"
#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr double kFloorDb = 80.0;  // shown below the strongest line
constexpr std::size_t kMostNamed = 9;

std::string LineName(const SpectralLine& line) {
  char text[48];
  if (line.harmonic == 1) {
    std::snprintf(text, sizeof text, "f = %.1f", line.frequency_hz.value);
  } else if (line.harmonic > 1) {
    std::snprintf(text, sizeof text, "%d f", line.harmonic);
  } else {
    std::snprintf(text, sizeof text, "%.0f", line.frequency_hz.value);
  }
  return text;
}

double Db(double power) { return 10.0 * std::log10(std::max(power, 1e-300)); }

// The strongest lines of the channel, those that would write over a stronger one's name left out.
std::vector<SpectralLine> Named(std::vector<SpectralLine> lines, bool heat_release, double max_hz) {
  const auto strength = [&](const SpectralLine& line) {
    return heat_release ? line.q_amplitude : line.p_amplitude;
  };
  std::ranges::sort(lines, std::greater<>(), strength);
  std::vector<SpectralLine> named;
  for (const SpectralLine& line : lines) {
    if (strength(line) <= 0.0 || line.frequency_hz.value > max_hz || named.size() >= kMostNamed) {
      continue;
    }
    const bool crowded = std::ranges::any_of(named, [&](const SpectralLine& other) {
      return std::abs(other.frequency_hz.value - line.frequency_hz.value) < 0.05 * max_hz;
    });
    if (!crowded) named.push_back(line);
  }
  return named;
}

}  // namespace

std::optional<Figure> SpectraFigure(const ReportInput& input) {
  const auto shown = ReferenceRecord(input);
  if (!shown) return std::nullopt;
  const Record& record = shown->record->record;
  const CrossSpectrum spectrum =
      WelchSpectrum(record.pressure, record.heat_release, record.sampling_hz);
  const MeasuredPoint* point = input.Measured(shown->record->name);
  const double fundamental = point != nullptr && point->has_cycle() && !shown->simulated
                                 ? point->frequency_hz.value
                                 : EstimateCharacteristics(record, spectrum).frequency_hz.value;
  const double max_hz = std::min(
      std::isfinite(fundamental) ? std::max(1000.0, ShownFrequencyMax(fundamental)) : 1000.0,
      0.45 * record.sampling_hz);
  const auto lines = FindLines(record, spectrum, std::isfinite(fundamental) ? fundamental : 0.0);

  CsvWriter csv("curve,frequency_hz,power_db,line");
  Script script;
  script.Line("set xrange [0:" + Number(max_hz) + "]").Line("unset key");
  const bool has_q = spectrum.HasHeatRelease();
  if (has_q) {
    script.Line("set multiplot layout 2,1 margins 0.14,0.96,0.15,0.97 spacing 0,0.09");
  }
  for (const bool heat_release : {false, true}) {
    if (heat_release && !has_q) break;
    const std::string curve = heat_release ? "q" : "p";
    const std::vector<double>& power = heat_release ? spectrum.qq : spectrum.pp;
    double top = -1e9;
    for (std::size_t k = 1; k < power.size(); ++k) {
      const double frequency = spectrum.Frequency(static_cast<int>(k));
      if (frequency > max_hz) break;
      csv.Cell(curve).Cell(frequency).Cell(Db(power[k])).Cell("").EndRow();
      top = std::max(top, Db(power[k]));
    }
    for (const SpectralLine& line : Named(lines, heat_release, max_hz)) {
      const auto bin =
          static_cast<std::size_t>(std::lround(line.frequency_hz.value / spectrum.bin_hz));
      if (bin >= power.size()) continue;
      csv.Cell(curve + " line").Cell(line.frequency_hz.value).Cell(Db(power[bin]));
      csv.Cell(LineName(line)).EndRow();
    }
    script.Line("set yrange [" + Number(top - kFloorDb) + ":" + Number(top + 18.0) + "]")
        .Line(heat_release || !has_q ? "set xlabel 'frequency (Hz)'" : "unset xlabel")
        .Line("set ylabel '" + curve + " (dB re 1 unit²/Hz)' offset 1")
        .Plot("data using (pick('" + curve + "',2)):3 with lines linewidth 1 linecolor rgb '" +
              (heat_release ? colour::kVermillion : colour::kBlue) + "'")
        .Plot("data using (pick('" + curve +
              " line',2)):3:(strcol(4)) with labels noenhanced offset 0,0.8 font ',11'")
        .EndPlot();
  }
  if (has_q) script.Line("unset multiplot");

  Figure figure;
  figure.title = (shown->simulated ? "Power spectra of the simulated record of "
                                   : "Power spectra of p and q, ") +
                 shown->record->name;
  figure.caption =
      "Welch's spectra, significant lines named: multiples of the fundamental f, and by their "
      "frequency in Hz the lines that are none." +
      (shown->simulated ? " Simulated: no measured record is at hand." +
                              SimulationRemark(input, shown->record->name)
                        : "");
  figure.csv = csv.Text();
  figure.script = script.Text();
  figure.height = 440;
  return figure;
}

}  // namespace howl
