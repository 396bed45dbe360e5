// Figure 1 of the paper: p and q of one experiment over 80 ms.
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr double kPaperWindow_s = 0.080;
constexpr double kShownPeriods = 8.0;

}  // namespace

std::optional<Figure> RecordsFigure(const ReportInput& input) {
  const auto shown = ReferenceRecord(input);
  if (!shown) return std::nullopt;
  const Record& record = shown->record->record;
  const MeasuredPoint* point = input.Measured(shown->record->name);
  double window_s = kPaperWindow_s;
  if (point != nullptr && point->has_cycle()) {
    window_s = std::max(window_s, kShownPeriods / point->frequency_hz.value);
  }
  const std::size_t count = std::min(
      record.pressure.size(), static_cast<std::size_t>(std::lround(window_s * record.sampling_hz)));
  const std::size_t first = (record.pressure.size() - count) / 2;
  const bool has_q = !record.heat_release.empty();
  CsvWriter csv("curve,time_ms,value");
  for (std::size_t i = 0; i < count; ++i) {
    csv.Cell("p").Cell(1e3 * static_cast<double>(i) / record.sampling_hz);
    csv.Cell(record.pressure[first + i]).EndRow();
  }
  for (std::size_t i = 0; has_q && i < count; ++i) {
    csv.Cell("q").Cell(1e3 * static_cast<double>(i) / record.sampling_hz);
    csv.Cell(record.heat_release[first + i]).EndRow();
  }
  const std::string name = shown->record->name;
  Figure figure;
  figure.title = (shown->simulated ? "Simulated record of " : "Record of ") + name;
  figure.caption = (shown->simulated ? "No measured record is at hand: this is what the loop "
                                       "does when simulated, in "
                                     : "Pressure and heat release as recorded in ") +
                   name + ", " + Spelled(1e3 * window_s, 3) + " ms from its middle." +
                   (shown->simulated ? SimulationRemark(input, name) : "");
  figure.csv = csv.Text();
  Script script;
  script.Line("set xrange [0:" + Number(1e3 * window_s) + "]").Line("unset key");
  if (has_q) {
    script.Line("set multiplot layout 2,1 margins 0.14,0.98,0.16,0.97 spacing 0,0.07");
    script.Line("set format x ''");
  } else {
    script.Line("set xlabel 'time (ms)'");
  }
  script.Line("set ylabel 'p (units of the record)' offset 1")
      .Plot("data using (pick('p',2)):3 with lines linewidth 1.3 linecolor rgb '" +
            std::string(colour::kBlue) + "'")
      .EndPlot();
  if (has_q) {
    script.Line("set format x '%g'")
        .Line("set xlabel 'time (ms)'")
        .Line("set ylabel 'q (units of the record)' offset 1")
        .Plot("data using (pick('q',2)):3 with lines linewidth 1.3 linecolor rgb '" +
              std::string(colour::kVermillion) + "'")
        .EndPlot()
        .Line("unset multiplot");
  }
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
