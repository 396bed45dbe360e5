#include "app/simulate/simulate_sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "app/simulate/simulate_start.h"
#include "app/text/text_table.h"
#include "estimation/parallel.h"
#include "io/results/csv_writer.h"
#include "io/user_error.h"
#include "model/cycles/continuation.h"

namespace howl {
namespace {

SweepOptions OptionsOf(const Config& config, const SimulationTimes& times) {
  const SweepSpec& sweep = *config.simulation.sweep;
  return {.from = sweep.from,
          .to = sweep.to,
          .one_way_s = sweep.one_way_s,
          .steps = sweep.steps,
          .sampling_hz = times.sampling_hz,
          .settle_s = times.settle_s};
}

// The ranges in which the branch through the cycle near `frequency_hz` attracts, within the sweep.
std::vector<ParameterInterval> Attracts(const SweptRig& rig, const SweepSpec& sweep, double at,
                                        double frequency_hz) {
  const ParameterPath path = [&](double value) {
    return WithParameter(rig.start.rig.model, sweep.parameter, value);
  };
  const std::vector<LimitCycle> cycles = CyclesOfInterest(path(at), rig.frequency_hz);
  const auto nearest = std::ranges::min_element(cycles, {}, [&](const LimitCycle& cycle) {
    return std::abs(cycle.frequency_hz - frequency_hz);
  });
  if (nearest == cycles.end()) return {};
  ContinuationOptions limits;
  limits.parameter_min = std::min(sweep.from, sweep.to);
  limits.parameter_max = std::max(sweep.from, sweep.to);
  return StableIntervals(ContinueCycle(path, at, *nearest, limits));
}

std::optional<ParameterInterval> Coexist(const SweptRig& rig, const SweepSpec& sweep,
                                         const SweepResult& result) {
  if (result.jumps.empty()) return std::nullopt;
  const SweepWindow& first = result.windows.front();
  const SweepWindow& farthest = result.windows[result.windows.size() / 2 - 1];
  const auto both = Intersect(Attracts(rig, sweep, sweep.from, first.frequency_hz),
                              Attracts(rig, sweep, sweep.to, farthest.frequency_hz));
  if (both.empty()) return std::nullopt;
  return both.front();
}

SweepResult RunSweep(const Config& config, const SimulationTimes& times, const SweptRig& rig) {
  const SweepOptions options = OptionsOf(config, times);
  SweepResult result;
  result.name = rig.name;
  result.windows = SweepInTime(rig.start, config.simulation.sweep->parameter, options);
  result.jumps = FindJumps(result.windows);
  result.hysteresis = FindHysteresis(result.windows, options);
  result.coexist = Coexist(rig, *config.simulation.sweep, result);
  return result;
}

const char* Direction(const SweepSpec& sweep, bool back) {
  return (sweep.to > sweep.from) != back ? "up" : "down";
}

}  // namespace

void CheckSweep(const Config& config, const SimulationTimes& times) {
  // A few cycles of a line are needed to tell it from the next one.
  constexpr double kLeastSamples = 256.0;
  const SweepSpec& sweep = *config.simulation.sweep;
  if (sweep.one_way_s * times.sampling_hz >= kLeastSamples * sweep.steps) return;
  std::ostringstream what;
  what << sweep.steps << " windows of " << sweep.one_way_s << " s at " << times.sampling_hz
       << " Hz have less than 256 samples each, expected fewer, or a longer one_way_s";
  throw UserError(config.source.string(), sweep.line, "simulate.sweep.steps", what.str());
}

std::vector<SweepResult> RunSweeps(const Config& config, const SimulationTimes& times,
                                   std::vector<SweptRig> rigs, int threads) {
  const SweepSpec& sweep = *config.simulation.sweep;
  std::vector<SweepResult> results(rigs.size());
  RunUnits(rigs.size(), threads, [&](std::size_t i) {
    RigParameters& parameters = rigs[i].start.rig;
    if (sweep.combustion_noise_relative) {
      // Of variance S0 f_c pi / 2 (model/noise/noise.h).
      const double std = *sweep.combustion_noise_relative * parameters.model.flame.saturation;
      parameters.noise.combustion_density =
          2.0 * std * std / (std::numbers::pi * parameters.noise.combustion_corner_hz);
    }
    // The loop at the sweep's start has cycles of its own.
    parameters.model = WithParameter(parameters.model, sweep.parameter, sweep.from);
    results[i] = RunSweep(config, times, rigs[i]);
  });
  return results;
}

std::string SweepCsv(const SweepSpec& sweep, const std::vector<SweepResult>& results) {
  CsvWriter csv("experiment,direction,parameter,value,frequency_hz,p_amplitude");
  for (const SweepResult& result : results) {
    for (const SweepWindow& window : result.windows) {
      csv.Cell(result.name)
          .Cell(Direction(sweep, window.back))
          .Cell(SweptParameterName(sweep.parameter))
          .Cell(window.parameter)
          .Cell(window.frequency_hz)
          .Cell(window.pressure_amplitude)
          .EndRow();
    }
  }
  return csv.Text();
}

std::string SweepText(const SweepSpec& sweep, const std::vector<SweepResult>& results) {
  const std::string name(SweptParameterName(sweep.parameter));
  std::string text = "sweep of " + name + " from " + Significant(sweep.from, 4) + " to " +
                     Significant(sweep.to, 4) + " and back, " + Significant(sweep.one_way_s, 3) +
                     " s each way, in " + std::to_string(sweep.steps) + " windows\n";
  TextTable table({"experiment", "direction", "jumps at", "from Hz", "to Hz"});
  bool any = false;
  for (const SweepResult& result : results) {
    for (const SweepJump& jump : result.jumps) {
      any = true;
      table.AddRow({result.name, Direction(sweep, jump.back), Significant(jump.parameter, 4),
                    Fixed(jump.from_hz, 1), Fixed(jump.to_hz, 1)});
    }
  }
  text += any ? table.Text() : "the strongest line of p never jumps\n";
  for (const SweepResult& result : results) {
    for (const ParameterInterval& interval : result.hysteresis) {
      text += Wrapped("hysteresis of " + result.name + ": from " + Significant(interval.lo, 4) +
                          " to " + Significant(interval.hi, 4) +
                          " the loop is elsewhere on the way down than on the way up",
                      2) +
              "\n";
    }
    if (result.coexist) {
      text += Wrapped("  by harmonic balance both cycles attract from " +
                          Significant(result.coexist->lo, 4) + " to " +
                          Significant(result.coexist->hi, 4) +
                          "; a slow sweep jumps late by what little noise there is, strong noise "
                          "makes it jump early",
                      4) +
              "\n";
    }
  }
  return text;
}

}  // namespace howl
