#include "app/input/export_flame.h"

#include <cmath>

#include "app/input/measured_flame.h"

namespace howl {
namespace {

double Positive(const Options& options, const std::string& option) {
  const double value = *options.Number(option);
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw UsageError(option + ": expected a number above zero");
  }
  return value;
}

ExportedFlame FlameOf(const Config& config, const ProblemInput& input,
                      const Experiment& experiment) {
  ExportedFlame exported{.name = experiment.name, .phi = experiment.phi, .origin = "none"};
  exported.flame.slope = 0.0;
  const double slope = experiment.flame_slope.value_or(0.0);
  if (!(slope < 0.0)) return exported;
  const SimulationSpec& spec = config.simulation;
  if (spec.flame_is_given) {
    exported.flame = {spec.flame_shape, slope, spec.saturation, 0.0};
    exported.origin = "config";
  } else if (const auto fit = MeasuredFlame(input, experiment)) {
    exported.flame = fit->WithSlopeAtRest(slope);
    exported.origin = "measured";
  } else {
    exported.flame = {FlameShape::kTanh, slope, 1.0, 0.0};
    exported.origin = "assumed";
  }
  return exported;
}

}  // namespace

std::optional<FlameScale> StatedScale(const Options& options) {
  const bool has_mean = options.Has("--mean-heat-release");
  if (has_mean != options.Has("--full-modulation")) {
    throw UsageError(std::string(has_mean ? "--mean-heat-release" : "--full-modulation") +
                     ": expected --mean-heat-release and --full-modulation together, or none");
  }
  if (!has_mean) return std::nullopt;
  return FlameScale{Positive(options, "--mean-heat-release"),
                    Positive(options, "--full-modulation")};
}

std::vector<ExportedFlame> FlamesToExport(const Config& config, const ProblemInput& input,
                                          const std::optional<FlameScale>& stated) {
  std::vector<ExportedFlame> flames;
  for (const Experiment& experiment : input.experiments) {
    ExportedFlame& flame = flames.emplace_back(FlameOf(config, input, experiment));
    flame.is_scaled = stated.has_value();
    if (stated) {
      flame.scale = *stated;
    } else if (flame.HasSlope()) {
      flame.scale = {flame.flame.saturation, -flame.flame.saturation / flame.SlopeAtRest()};
    }
  }
  return flames;
}

}  // namespace howl
