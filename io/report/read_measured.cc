#include "io/report/read_measured.h"

#include <cmath>
#include <limits>
#include <optional>

#include "estimation/analysis/loop/delay.h"

namespace howl {
namespace {

using Json = nlohmann::json;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

MeasuredPoint Published(const Experiment& experiment) {
  MeasuredPoint point;
  point.name = experiment.name;
  point.phi = experiment.phi;
  point.frequency_hz = {experiment.frequency_hz, experiment.frequency_std_hz.value_or(kNotANumber)};
  point.phase_deg = {experiment.phase_deg, experiment.phase_std_deg.value_or(kNotANumber)};
  point.gain = {experiment.gain, experiment.gain_std.value_or(kNotANumber)};
  point.reliable = experiment.reliable;
  point.tau_s = DelayOnBranch({point.frequency_hz, point.phase_deg}, experiment.delay_periods);
  if (!experiment.phase_std_deg) point.tau_s.std = kNotANumber;
  if (experiment.flame_slope) {
    point.flame_slope = {*experiment.flame_slope, experiment.flame_slope_std.value_or(kNotANumber)};
    point.loop_gain = LoopGainFromSlope(point.gain, point.frequency_hz, point.flame_slope);
    // An error that is not known is not zero.
    if (!experiment.flame_slope_std || !experiment.gain_std) point.loop_gain.std = kNotANumber;
  }
  return point;
}

MeasuredPoint Analysed(const Json& json) {
  MeasuredPoint point;
  point.name = json.value("name", "");
  point.phi = NumberAt(json, "phi");
  const Json cycle = json.value("cycle", Json::object());
  point.reliable = false;
  if (cycle.value("state", "") == "no_limit_cycle") return point;
  point.reliable = cycle.value("stationary", false);
  point.frequency_hz = EstimateAt(cycle, "frequency");
  point.phase_deg = EstimateAt(cycle, "phase");
  point.gain = EstimateAt(cycle, "gain");
  point.tau_s = EstimateAt(json, "tau");
  point.loop_gain = EstimateAt(json, "loop_gain");
  if (json.contains("flame") && json["flame"].is_object()) {
    point.flame_slope = EstimateAt(json["flame"], "slope");
  }
  return point;
}

// The whole periods that a fitted delay has beyond the shortest of (3).
int PeriodsOf(double tau_s, const Experiment& experiment) {
  const Estimate shortest =
      DelayOnBranch({{experiment.frequency_hz, 0.0}, {experiment.phase_deg, 0.0}}, 0);
  const double periods = (tau_s - shortest.value) * experiment.frequency_hz;
  return std::isfinite(periods) ? static_cast<int>(std::lround(periods)) : 0;
}

// A row of family.json's or solution.json's experiments: the characteristics that the command used.
MeasuredPoint Kept(const Json& row) {
  const auto optional = [&](const char* key) {
    const double value = NumberAt(row, key);
    return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
  };
  Experiment experiment;
  experiment.name = row.value("name", "");
  experiment.phi = NumberAt(row, "phi");
  experiment.reliable = row.value("reliable", true);
  experiment.frequency_hz = NumberAt(row, "frequency_hz");
  experiment.phase_deg = NumberAt(row, "phase_deg");
  experiment.gain = NumberAt(row, "gain");
  experiment.flame_slope = optional("flame_slope");
  experiment.frequency_std_hz = optional("frequency_std_hz");
  experiment.phase_std_deg = optional("phase_std_deg");
  experiment.gain_std = optional("gain_std");
  experiment.flame_slope_std = optional("flame_slope_std");
  experiment.delay_periods =
      row.value("delay_periods", PeriodsOf(NumberAt(row, "tau_s"), experiment));
  return Published(experiment);
}

const Json* RowOf(const Json& file, const std::string& name) {
  for (const Json& row : ListAt(file, "experiments")) {
    if (row.is_object() && row.value("name", "") == name) return &row;
  }
  return nullptr;
}

}  // namespace

std::vector<MeasuredPoint> ReadMeasured(const ReportInput& input) {
  std::vector<MeasuredPoint> measured;
  if (!input.config) {
    const bool fitted = !ListAt(input.solution, "experiments").empty();
    for (const Json& row : ListAt(fitted ? input.solution : input.family, "experiments")) {
      measured.push_back(Kept(row));
    }
    return measured;
  }
  for (const ExperimentConfig& each : input.config->experiments) {
    const std::string& name = each.experiment.name;
    if (const Json* analysed = RowOf(input.analysis, name)) {
      measured.push_back(Analysed(*analysed));
      measured.back().reliable = measured.back().reliable && each.experiment.reliable;
    } else if (!each.record) {
      measured.push_back(Published(each.experiment));
    } else if (const Json* tested = RowOf(input.family, name)) {
      measured.push_back(Kept(*tested));  // with the errors that solution.json does not have
    } else if (const Json* fitted = RowOf(input.solution, name)) {
      measured.push_back(Kept(*fitted));
    }
  }
  return measured;
}

}  // namespace howl
