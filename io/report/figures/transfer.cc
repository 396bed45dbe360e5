// The q-to-p transfer wherever the two channels are coherent, with its 95 % intervals, and the
// model's: gain above, phase below, one column for each of a few experiments.
#include <algorithm>
#include <cmath>

#include "estimation/analysis/spectra/half_width.h"
#include "io/report/figures/catalogue.h"
#include "io/report/figures/curves.h"
#include "io/report/script.h"
#include "io/results/csv_writer.h"

namespace howl {
namespace {

constexpr std::size_t kColumns = 3;
constexpr std::size_t kMostTransferPoints = 150;
constexpr int kTransferFrequencies = 300;

// Experiments that the figure has room for: spread evenly over the operating range.
std::vector<std::string> Chosen(const std::vector<std::string>& names) {
  if (names.size() <= kColumns) return names;
  std::vector<std::string> out;
  for (std::size_t k = 0; k < kColumns; ++k) {
    out.push_back(names[k * (names.size() - 1) / (kColumns - 1)]);
  }
  return out;
}

// The modes that analyse fitted to the transfer alone.
std::optional<LoopModel> TransferFitModel(const ReportInput& input, const std::string& name) {
  if (!input.analysis.contains("experiments")) return std::nullopt;
  for (const auto& each : input.analysis["experiments"]) {
    if (each.value("name", "") != name || !each.contains("transfer")) continue;
    const auto& fit = each["transfer"];
    LoopModel model;
    model.omega_hz = EstimateAt(fit, "omega_hz").value;
    model.xi = EstimateAt(fit, "xi").value;
    model.N = EstimateAt(fit, "N").value;
    model.M = EstimateAt(fit, "M").value;
    if (input.config) model.harmonic_ratio = input.config->model.harmonic_ratio;
    if (std::isfinite(model.omega_hz + model.xi + model.N + model.M)) return model;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Figure> TransferFigure(const ReportInput& input) {
  if (!input.transfer) return std::nullopt;
  const CsvTable& table = *input.transfer;
  std::vector<std::string> with_cycle;
  std::vector<std::string> all;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string name = table.Text(row, "name");
    if (!all.empty() && all.back() == name) continue;
    all.push_back(name);
    const MeasuredPoint* point = input.Measured(name);
    if (point != nullptr && point->has_cycle()) with_cycle.push_back(name);
  }
  const std::vector<std::string> names = Chosen(with_cycle.empty() ? all : with_cycle);
  CsvWriter csv("curve,frequency_hz,gain,gain_lo,gain_hi,phase_deg,phase_lo_deg,phase_hi_deg");
  double low = INFINITY;
  double high = 0.0;
  bool any_transfer_fit = false;
  bool any_joint_fit = false;
  for (const std::string& name : names) {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      if (table.Text(row, "name") == name) rows.push_back(row);
    }
    const std::size_t step = std::max<std::size_t>(1, rows.size() / kMostTransferPoints);
    for (std::size_t k = 0; k < rows.size(); k += step) {
      const std::complex<double> h(table.Number(rows[k], "re"), table.Number(rows[k], "im"));
      const double half = HalfWidth95(std::sqrt(
          0.5 * (table.Number(rows[k], "variance_re") + table.Number(rows[k], "variance_im"))));
      const double gain = std::abs(h);
      const double phase_half =
          half < gain ? std::asin(half / gain) * 180.0 / 3.14159265358979323846 : 180.0;
      const double frequency = table.Number(rows[k], "frequency_hz");
      low = std::min(low, frequency);
      high = std::max(high, frequency);
      csv.Cell("data " + name).Cell(frequency).Cell(gain).Cell(std::max(gain - half, 0.02 * gain));
      csv.Cell(gain + half).Cell(PhaseDeg(h)).Cell(PhaseDeg(h) - phase_half);
      csv.Cell(PhaseDeg(h) + phase_half).EndRow();
    }
    if (rows.empty()) continue;
    const auto grid =
        LogarithmicGrid(table.Number(rows.front(), "frequency_hz"),
                        table.Number(rows.back(), "frequency_hz"), kTransferFrequencies);
    const auto add = [&](const std::string& curve, const LoopModel& model) {
      for (const double frequency : grid) {
        const std::complex<double> value = AcousticsAt(model, frequency);
        csv.Cell(curve + name).Cell(frequency).Cell(std::abs(value)).Cell(NAN).Cell(NAN);
        csv.Cell(PhaseDeg(value)).Cell(NAN).Cell(NAN).EndRow();
      }
    };
    if (const auto fit = TransferFitModel(input, name)) {
      add("transfer fit ", *fit);
      any_transfer_fit = true;
    }
    if (const ExperimentModel* fit = input.Fitted(name)) {
      add("joint fit ", fit->model);
      any_joint_fit = true;
    }
  }
  if (!(high > low)) return std::nullopt;
  Figure figure;
  figure.title = "Coherent q-to-p transfer, and the model's";
  figure.caption =
      "Where p and q are coherent the records show G beyond the limit cycle: measured transfer "
      "with 95 % intervals" +
      std::string(any_transfer_fit ? "; the model's modes fitted to it alone" : "") +
      (any_joint_fit ? "; the joint fit" : "") + "." +
      std::string(names.size() < all.size()
                      ? " " + std::to_string(names.size()) + " of " + std::to_string(all.size()) +
                            " experiments; transfer.csv has all."
                      : "");
  figure.csv = csv.Text();
  figure.width = 900;
  figure.height = 560;
  const std::string columns = std::to_string(names.size());
  Script script;
  script.Line("set logscale x")
      .Line("set xtics (20, 100, 500, 2000, 10000)")
      .Line("set xrange [" + Number(0.9 * low) + ":" + Number(1.1 * high) + "]")
      .Line("set multiplot layout 2," + columns + " margins 0.08,0.98,0.11,0.80 spacing 0.06,0.05");
  for (const bool phase : {false, true}) {
    if (phase) {
      script.Line("unset logscale y").Line("set format y '%g'").Line("set format x '%g'");
      script.Line("set xlabel 'frequency (Hz)'").Line("unset key").Line("unset title");
      script.Line("set yrange [-180:180]").Line("set ytics 90");
    } else {
      script.Line("set logscale y").Line("set format y '%g'").Line("set format x ''");
      script.Line("set key at screen 0.98, screen 0.99");
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (i == 0) {
        script.Line(phase ? "set ylabel 'phase (degrees)'" : "set ylabel '|p/q|'");
      } else {
        script.Line("unset ylabel").Line("unset key");
      }
      if (!phase) script.Line("set title " + Quoted(names[i]) + " noenhanced offset 0,-0.6");
      const std::string pick = "data using (pick(" + Quoted("data " + names[i]) + ",2)):";
      script.Plot(pick + (phase ? "7:(0):($8-$7)" : "4:(0):($5-$4)") +
                  " with vectors nohead linewidth 0.6 linecolor rgb '" + colour::kGrey +
                  "' notitle");
      script.Plot(pick + (phase ? "6" : "3") +
                  " with points pointtype 7 pointsize 0.25 linecolor rgb '" + colour::kGrey +
                  "' title 'measured, 95 %'");
      if (any_transfer_fit) {
        script.Plot("data using (pick(" + Quoted("transfer fit " + names[i]) +
                    ",2)):" + (phase ? "6" : "3") + " with lines linewidth 1.6 linecolor rgb '" +
                    colour::kVermillion + "' title 'fitted to the transfer'");
      }
      if (any_joint_fit) {
        script.Plot("data using (pick(" + Quoted("joint fit " + names[i]) + ",2)):" +
                    (phase ? "6" : "3") + " with lines linewidth 1.6 dashtype 2 linecolor rgb '" +
                    colour::kBlue + "' title 'joint fit'");
      }
      script.EndPlot();
    }
  }
  script.Line("unset multiplot");
  figure.script = script.Text();
  return figure;
}

}  // namespace howl
