// Limit cycles of the fitted loop at the reference experiment as the flame's slope, and with it the
// loop's gain at rest, is turned: born where the gain is one, and followed by continuation.
#include <cmath>

#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"
#include "model/cycles/continuation.h"

namespace howl {
namespace {

constexpr double kHighestGain = 2.0;

const char* KindName(BifurcationKind kind) {
  switch (kind) {
    case BifurcationKind::kHopf:
      return "Hopf";
    case BifurcationKind::kFold:
      return "fold";
    case BifurcationKind::kTorus:
      return "torus";
    case BifurcationKind::kPeriodDoubling:
      return "period doubling";
    case BifurcationKind::kBranchPoint:
      break;
  }
  return "branch point";
}

}  // namespace

std::optional<Figure> BifurcationFigure(const ReportInput& input) {
  const MeasuredPoint* reference = input.Reference();
  if (reference == nullptr || input.Fitted(reference->name) == nullptr) return std::nullopt;
  // A fit that did not converge gives no loop: its parameters are those where its search gave up.
  if (!input.solution.value("converged", false)) return std::nullopt;
  const LoopModel& model = input.Fitted(reference->name)->model;
  const double response = std::abs(RateAt(model, reference->frequency_hz.value));
  const SimulationSpec spec = input.config ? input.config->simulation : SimulationSpec{};
  const auto path = [&](double loop_gain) {
    return ClosedLoop{model.Loop(),
                      {spec.flame_shape, -loop_gain / response, spec.saturation, 0.0}};
  };
  const double highest =
      std::max(kHighestGain,
               std::isfinite(reference->loop_gain.value) ? 1.3 * reference->loop_gain.value : 0);
  const double start = 0.8 * highest;
  CsvWriter csv("curve,loop_gain,p_amplitude,frequency_hz,kind");
  struct Drawn {
    std::string name;
    double frequency_hz;
    bool stable, unstable;
  };
  std::vector<Drawn> branches;
  for (const LimitCycle& cycle : LimitCycles(path(start), 4.5 * reference->frequency_hz.value)) {
    ContinuationOptions options;
    options.parameter_min = 0.5;
    options.parameter_max = highest;
    options.max_points = 90;
    // A picture does not need ten digits.
    options.first_step = 0.05;
    options.max_step = 0.1;
    options.balance.tolerance = 1e-7;
    options.balance.max_harmonics = 64;
    options.floquet.tolerance = 3e-3;
    options.floquet.min_steps = 32;
    options.floquet.max_dimension = 200;
    const Branch branch = ContinueCycle(path, start, cycle, options);
    if (branch.points.size() < 3) continue;
    Drawn drawn{"branch " + std::to_string(branches.size() + 1), cycle.frequency_hz, false, false};
    bool last = branch.points.front().stable;
    for (const BranchPoint& point : branch.points) {
      const auto row = [&](bool stable) {
        csv.Cell(drawn.name + (stable ? " stable" : " unstable")).Cell(point.parameter);
        csv.Cell(point.cycle.pressure_amplitude()).Cell(point.cycle.frequency_hz).Cell("");
        csv.EndRow();
        (stable ? drawn.stable : drawn.unstable) = true;
      };
      if (point.stable != last) {
        row(last);  // the piece ends where the next one begins
      }
      last = point.stable;
      row(point.stable);
    }
    for (const Bifurcation& bifurcation : branch.bifurcations) {
      double amplitude = 0.0;
      double nearest = INFINITY;
      for (const BranchPoint& point : branch.points) {
        const double distance = std::abs(point.parameter - bifurcation.parameter);
        if (distance < nearest && bifurcation.kind != BifurcationKind::kHopf) {
          nearest = distance;
          amplitude = point.cycle.pressure_amplitude();
        }
      }
      csv.Cell("bifurcations").Cell(bifurcation.parameter).Cell(amplitude);
      csv.Cell(bifurcation.frequency_hz).Cell(KindName(bifurcation.kind)).EndRow();
    }
    branches.push_back(drawn);
  }
  if (branches.empty()) return std::nullopt;
  Figure figure;
  figure.title = "Limit cycles over the loop gain, " + reference->name;
  figure.caption =
      "Amplitude of p on the cycles of the fitted loop as the flame's slope is turned, by harmonic "
      "balance and continuation (saturation of the heat release: simulate's). Solid: attracting; "
      "dashed: not." +
      std::string(std::isfinite(reference->loop_gain.value) ? " Dotted: the measured loop gain."
                                                            : "");
  figure.csv = csv.Text();
  Script script;
  script.Line("set xlabel 'loop gain at rest, |L Φ′(0)|'")
      .Line("set ylabel 'amplitude of p (units of the record)'")
      .Line("set xrange [0.5:" + Number(highest) + "]")
      .Line("set yrange [0:*]")
      .Line("set key outside top center horizontal maxcols 2");
  if (std::isfinite(reference->loop_gain.value)) {
    const std::string x = Number(reference->loop_gain.value);
    script.Line("set arrow from " + x + ", graph 0 to " + x +
                ", graph 1 nohead linewidth 1 dashtype 3 linecolor rgb '" + colour::kInk + "'");
  }
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const std::string colour = SeriesColour(i, branches.size());
    char title[64];
    std::snprintf(title, sizeof title, "cycle near %.0f Hz", branches[i].frequency_hz);
    if (branches[i].stable) {
      script.Plot("data using (pick('" + branches[i].name +
                  " stable',2)):3 with lines linewidth 2 "
                  "linecolor rgb '" +
                  colour + "' title '" + title + "'");
    }
    if (branches[i].unstable) {
      script.Plot("data using (pick('" + branches[i].name +
                  " unstable',2)):3 with lines linewidth "
                  "1.3 dashtype 2 linecolor rgb '" +
                  colour +
                  (branches[i].stable ? "' notitle" : "' title '" + std::string(title) + "'"));
    }
  }
  script.Plot(
      "data using (pick('bifurcations',2)):3 with points pointtype 6 pointsize 0.9 linewidth "
      "1.3 linecolor rgb '" +
      std::string(colour::kInk) + "' title 'bifurcations'");
  script.EndPlot();
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
