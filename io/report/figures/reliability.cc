// A trial's reliability curve: of the answers given with a probability, how many were right.
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {

std::optional<Figure> ReliabilityFigure(const ReportInput& input) {
  if (!input.trial.contains("diagnose") || !input.trial["diagnose"].contains("reliability")) {
    return std::nullopt;
  }
  CsvWriter csv("curve,mean_probability,share_right,lo,hi,cases");
  int bins = 0;
  for (const auto& bin : input.trial["diagnose"]["reliability"]) {
    const double probability = NumberAt(bin, "mean_probability");
    const auto& right = bin.at("right");
    if (!std::isfinite(probability) || NumberAt(right, "total") < 1.0) continue;
    ++bins;
    csv.Cell("answers").Cell(probability).Cell(NumberAt(right, "share"));
    csv.Cell(right.at("interval").at(0).get<double>());
    csv.Cell(right.at("interval").at(1).get<double>()).Cell(NumberAt(right, "total")).EndRow();
  }
  if (bins == 0) return std::nullopt;
  Figure figure;
  figure.title = "Reliability of the probabilities";
  figure.caption =
      "Share of right answers among those given with a like probability, with 95 % (Wilson) "
      "intervals and the number of cases. On the line a probability means what it says; below it "
      "the diagnosis is too sure.";
  figure.csv = csv.Text();
  figure.height = 400;
  Script script;
  script.Line("set size square")
      .Line("set xlabel 'probability of the answer'")
      .Line("set ylabel 'share of right answers'")
      .Line("set xrange [0:1.05]")
      .Line("set yrange [0:1.05]")
      .Line("set key bottom right")
      .Plot("x <= 1 ? x : NaN with lines linewidth 1 dashtype 3 linecolor rgb '" +
            std::string(colour::kInk) + "' title 'calibrated'")
      .Plot(
          "data using (pick('answers',2)):4:(0):($5-$4) with vectors nohead linewidth 1.4 "
          "linecolor rgb '" +
          std::string(colour::kBlue) + "' notitle")
      .Plot(
          "data using (pick('answers',2)):3 with points pointtype 7 pointsize 0.9 linecolor rgb '" +
          std::string(colour::kBlue) + "' title 'answers, 95 %'")
      .Plot(
          "data using (pick('answers',2)):3:(sprintf('%d',$6)) with labels right offset -0.8,0 "
          "font ',11' notitle")
      .EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
