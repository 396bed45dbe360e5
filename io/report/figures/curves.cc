#include "io/report/figures/curves.h"

#include <cmath>
#include <numbers>

#include "io/report/script.h"
#include "model/loop/loop.h"
#include "model/numerics/units.h"

namespace howl {

std::vector<double> LinearGrid(double low, double high, int count) {
  std::vector<double> grid;
  for (int i = 0; i < count; ++i) grid.push_back(low + (high - low) * i / (count - 1));
  return grid;
}

std::vector<double> LogarithmicGrid(double low, double high, int count) {
  std::vector<double> grid;
  for (int i = 0; i < count; ++i) grid.push_back(low * std::pow(high / low, i / (count - 1.0)));
  return grid;
}

double Decibels(double ratio) { return 20.0 * std::log10(ratio); }

double PhaseDeg(std::complex<double> value) { return std::arg(value) * 180.0 / std::numbers::pi; }

std::complex<double> AcousticsAt(const LoopModel& model, double frequency_hz) {
  const Complex<double> value = AcousticResponse(model.Loop().acoustics, frequency_hz);
  return {value.re, value.im};
}

std::complex<double> RateAt(const LoopModel& model, double frequency_hz) {
  return std::complex<double>(0.0, kRadPerSPerHz * frequency_hz) * AcousticsAt(model, frequency_hz);
}

std::optional<ShownRecord> ReferenceRecord(const ReportInput& input) {
  const MeasuredPoint* reference = input.Reference();
  if (reference != nullptr) {
    if (const NamedRecord* record = input.RecordOf(reference->name))
      return ShownRecord{record, false};
    if (const NamedRecord* record = input.SimulatedOf(reference->name)) {
      return ShownRecord{record, true};
    }
  }
  if (!input.records.empty()) return ShownRecord{&input.records.front(), false};
  if (!input.simulated.empty()) return ShownRecord{&input.simulated.front(), true};
  return std::nullopt;
}

double DrawnSlope(const MeasuredPoint& point, const LoopModel& model) {
  if (std::isfinite(point.flame_slope.value)) return point.flame_slope.value;
  return -1.0 / std::abs(RateAt(model, point.frequency_hz.value));
}

std::string SimulationRemark(const ReportInput& input, const std::string& experiment) {
  const double member = NumberAt(input.simulation, "member");
  const bool is_fit = std::isnan(member);
  std::string text =
      is_fit ? "" : " It ran member " + Number(member) + " of the family, not the joint fit.";
  for (const auto& loop : ListAt(input.simulation, "experiments")) {
    if (loop.value("name", "") != experiment || !loop.value("slope_raised", false)) continue;
    const double gain = NumberAt(loop, "loop_gain");
    const std::string lacking = gain > 0.0 ? "the " + std::string(is_fit ? "fit's" : "member's") +
                                                 " loop gain is " + Spelled(gain)
                                           : "no slope was measured";
    text += " The flame's slope was raised to a loop gain of " +
            Spelled(NumberAt(loop, "loop_gain_simulated")) + ": " + lacking +
            ", but a cycle was observed.";
  }
  return text;
}

double ShownFrequencyMax(double fundamental_hz) {
  const double step = fundamental_hz > 100.0 ? 100.0 : 50.0;
  return step * std::ceil(4.5 * fundamental_hz / step);
}

}  // namespace howl
