// Figure 8 of the paper for the data at hand: Bode's diagram of G at one experiment for members of
// the family, which all pass through the measured point and differ elsewhere.
#include <algorithm>
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr std::size_t kResponsesDrawn = 40;
constexpr int kFamilyFrequencies = 140;

void AddCurve(CsvWriter& csv, const std::string& curve, const LoopModel& model,
              const std::vector<double>& grid) {
  for (const double frequency : grid) {
    const std::complex<double> value = AcousticsAt(model, frequency);
    csv.Cell(curve).Cell(frequency).Cell(std::abs(value)).Cell(PhaseDeg(value)).EndRow();
  }
}

}  // namespace

std::optional<Figure> FamilyBodeFigure(const ReportInput& input) {
  const MeasuredPoint* reference = input.Reference();
  if (reference == nullptr || !input.members) return std::nullopt;
  const int experiment = input.members->Experiment(reference->name);
  if (experiment < 0) return std::nullopt;
  const auto index = static_cast<std::size_t>(experiment);
  const double f = reference->frequency_hz.value;
  std::vector<double> grid = LogarithmicGrid(f / 4.0, ShownFrequencyMax(f), kFamilyFrequencies);
  grid.insert(std::ranges::upper_bound(grid, f), f);  // where all members meet
  CsvWriter csv("curve,frequency_hz,gain,phase_deg");
  const auto drawn = input.members->Thinned(kResponsesDrawn);
  for (const std::size_t member : drawn) {
    AddCurve(csv, "member " + std::to_string(member + 1), input.members->models[member][index],
             grid);
  }
  const ExperimentModel* fit = input.Fitted(reference->name);
  if (fit != nullptr) AddCurve(csv, "fit", fit->model, grid);
  csv.Cell("measured").Cell(f).Cell(reference->gain.value).Cell(reference->phase_deg.value);
  csv.EndRow();

  Figure figure;
  figure.title = "Acoustics G that the data cannot reject, " + reference->name;
  figure.caption = std::to_string(drawn.size()) + " of " +
                   std::to_string(input.members->models.size()) +
                   " members: all pass through the measured point (star), where alone the limit "
                   "cycle shows the acoustics.";
  figure.csv = csv.Text();
  figure.height = 440;
  Script script;
  script.Line("set logscale x")
      .Line("set xtics (10, 20, 50, 100, 200, 500, 1000, 2000, 5000)")
      .Line("set xrange [" + Number(grid.front()) + ":" + Number(grid.back()) + "]")
      .Line("set multiplot layout 2,1 margins 0.14,0.96,0.15,0.97 spacing 0,0.06");
  for (const bool phase : {false, true}) {
    const std::string column = phase ? "4" : "3";
    if (phase) {
      script.Line("unset logscale y").Line("set format y '%g'").Line("set format x '%g'");
      script.Line("set xlabel 'frequency (Hz)'").Line("set ylabel 'phase of G (degrees)' offset 1");
      script.Line("set yrange [-100:100]").Line("set ytics 45").Line("unset key");
    } else {
      script.Line("set logscale y").Line("set format x ''").Line("set format y '%g'");
      script.Line("set ylabel '|G| (units of p per q)' offset 1");
    }
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      script.Plot("data using (pick('member " + std::to_string(drawn[k] + 1) + "',2)):" + column +
                  " with lines linewidth 0.5 linecolor rgb '" + colour::kGrey +
                  (k == 0 ? "' title 'members'" : "' notitle"));
    }
    if (fit != nullptr) {
      script.Plot("data using (pick('fit',2)):" + column +
                  " with lines linewidth 1.8 linecolor "
                  "rgb '" +
                  std::string(colour::kBlue) + "' title 'joint fit'");
    }
    script.Plot("data using (pick('measured',2)):" + column +
                " with points pointtype 3 pointsize 1.4 linewidth 2 linecolor rgb '" +
                colour::kVermillion + "' title 'measured'");
    script.EndPlot();
  }
  script.Line("unset multiplot");
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
