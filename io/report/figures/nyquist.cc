// Figure 12 of the paper: Nyquist's curve of the loop at one experiment, with its crossings of the
// negative real axis.
#include <algorithm>
#include <cmath>
#include <functional>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"
#include "model/loop/crossings.h"

namespace howl {
namespace {

constexpr std::size_t kCurvesDrawn = 12;
constexpr double kMemberStepDeg = 4.0;
constexpr double kMinGain = 0.05;  // crossings nearer to the origin are not named

std::string SlopeRemark(bool has_slope, double loop_gain) {
  if (!has_slope) {
    return " The flame's slope was not measured: the curve is scaled to a loop gain of one at the "
           "limit cycle.";
  }
  if (loop_gain >= 1.0) return "";
  return " With the measured slope the fit's loop gain at the limit cycle is " +
         Spelled(loop_gain) + ", below the one that (1b) asks of a loop that cycles by itself.";
}

}  // namespace

std::optional<Figure> NyquistFigure(const ReportInput& input) {
  const MeasuredPoint* reference = input.Reference();
  if (reference == nullptr || input.Fitted(reference->name) == nullptr) return std::nullopt;
  const LoopModel& model = input.Fitted(reference->name)->model;
  const bool has_slope = std::isfinite(reference->flame_slope.value);
  const double slope = DrawnSlope(*reference, model);
  const double loop_gain = std::abs(slope) * std::abs(RateAt(model, reference->frequency_hz.value));
  const double max_hz = 4.2 * reference->frequency_hz.value;
  CsvWriter csv("curve,re,im,frequency_hz,label");
  // The range is that of the fit; members that go far beyond it leave the picture.
  double left = -1.2, right = 1.0, bottom = -1.0, top = 1.0;
  const auto add = [&](const std::string& curve, const LoopModel& loop, double step_deg) {
    for (const NyquistPoint& point : NyquistCurve(loop.Loop(), slope, max_hz, step_deg)) {
      if (curve == "fit") left = std::min(left, point.response.real());
      if (curve == "fit") right = std::max(right, point.response.real());
      if (curve == "fit") bottom = std::min(bottom, point.response.imag());
      if (curve == "fit") top = std::max(top, point.response.imag());
      csv.Cell(curve).Cell(point.response.real()).Cell(point.response.imag());
      csv.Cell(point.frequency_hz).Cell("").EndRow();
    }
  };
  std::vector<std::size_t> drawn;
  const int experiment = input.members ? input.members->Experiment(reference->name) : -1;
  if (experiment >= 0) {
    drawn = input.members->Thinned(kCurvesDrawn);
    for (const std::size_t member : drawn) {
      add("member " + std::to_string(member + 1),
          input.members->models[member][static_cast<std::size_t>(experiment)], kMemberStepDeg);
    }
  }
  add("fit", model, 2.0);
  std::string told;
  int named = 0;
  std::vector<PhaseCrossing> crossings = PhaseCrossings(model.Loop(), slope, max_hz);
  std::erase_if(crossings, [](const PhaseCrossing& each) { return each.gain < kMinGain; });
  std::ranges::sort(crossings, std::greater<>(), &PhaseCrossing::gain);
  for (const PhaseCrossing& crossing : crossings) {
    csv.Cell(++named % 2 == 1 ? "crossing" : "crossing below")
        .Cell(-crossing.gain)
        .Cell(0.0)
        .Cell(crossing.frequency_hz);
    csv.Cell(Number(std::round(crossing.frequency_hz * 10.0) / 10.0) + " Hz").EndRow();
  }
  std::ranges::sort(crossings, {}, &PhaseCrossing::frequency_hz);
  for (const PhaseCrossing& crossing : crossings) {
    char text[64];
    std::snprintf(text, sizeof text, "%s%.1f Hz (%.3f)", told.empty() ? "" : ", ",
                  crossing.frequency_hz, crossing.gain);
    told += text;
  }
  csv.Cell("critical").Cell(-1.0).Cell(0.0).Cell(NAN).Cell("").EndRow();

  Figure figure;
  figure.title = "Nyquist's curve of the loop, " + reference->name;
  figure.caption = "|Φ'(0)| L(j 2π f) up to " + Number(std::round(max_hz)) +
                   " Hz for the joint fit" + (drawn.empty() ? "" : " and some members (thin)") +
                   ". Bullets: crossings of the negative real axis (gain in brackets): " + told +
                   ". Beyond −1 a crossing lets a cycle grow." + SlopeRemark(has_slope, loop_gain);
  figure.csv = csv.Text();
  figure.height = 520;
  Script script;
  script.Line("set size ratio -1")
      .Line("set xlabel 'real part of |Φ′(0)| L'")
      .Line("set ylabel 'imaginary part of |Φ′(0)| L'")
      .Line("set xzeroaxis linewidth 0.8 linecolor rgb '" + std::string(colour::kInk) + "'")
      .Line("set yzeroaxis linewidth 0.8 linecolor rgb '" + std::string(colour::kInk) + "'")
      .Line("set xrange [" + Number(left - 0.12 * (right - left)) + ":" +
            Number(right + 0.05 * (right - left)) + "]")
      .Line("set yrange [" + Number(bottom - 0.05 * (top - bottom)) + ":" +
            Number(top + 0.05 * (top - bottom)) + "]")
      .Line("set key outside top center horizontal");
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    script.Plot("data using (pick('member " + std::to_string(drawn[k] + 1) +
                "',2)):3 with lines linewidth 0.5 linecolor rgb '" + colour::kGrey +
                (k == 0 ? "' title 'members'" : "' notitle"));
  }
  script
      .Plot("data using (pick('fit',2)):3 with lines linewidth 1.6 linecolor rgb '" +
            std::string(colour::kBlue) + "' title 'joint fit'")
      .Plot(
          "data using (pick('critical',2)):3 with points pointtype 1 pointsize 1.3 linewidth 2 "
          "linecolor rgb '" +
          std::string(colour::kInk) + "' title '−1'")
      .Plot(
          "data using (strcol(1)[1:8] eq 'crossing' ? $2 : NaN):3 with points pointtype 7 "
          "pointsize 0.8 linecolor rgb '" +
          std::string(colour::kVermillion) + "' title 'crossings'");
  // Names above and below the axis in turn, where neighbours would write over each other.
  for (const bool below : {false, true}) {
    script.Plot(
        "data using (pick('crossing" + std::string(below ? " below" : "") +
        "',2)):3:(strcol(5)) with labels noenhanced " +
        (below ? "left rotate by -40 offset 0.4,-0.6" : "left rotate by 40 offset 0.4,0.6") +
        " font ',11' textcolor rgb '" + colour::kVermillion + "' notitle");
  }
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
