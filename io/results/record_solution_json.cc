#include "io/results/record_solution_json.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimation/joint_records/loop_names.h"
#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

Json EstimateJson(const Estimate& estimate) {
  return {{"value", NumberOrNull(estimate.value)}, {"std", NumberOrNull(estimate.std)}};
}

Json ModesJson(const FittedLoop& loop) {
  Json modes = Json::array();
  for (const FittedMode& mode : loop.modes) {
    modes.push_back({{"omega_hz", EstimateJson(mode.omega_hz)},
                     {"xi", EstimateJson(mode.xi)},
                     {"N", EstimateJson(mode.N)},
                     {"B", EstimateJson(mode.B)}});
  }
  return modes;
}

Json LinesJson(const std::vector<FittedLineError>& lines) {
  Json out = Json::array();
  for (const FittedLineError& line : lines) {
    out.push_back({{"multiple", line.multiple},
                   {"real", EstimateJson(line.real)},
                   {"imaginary", EstimateJson(line.imaginary)}});
  }
  return out;
}

Json OtherDelaysJson(const std::vector<OtherDelay>& delays) {
  Json out = Json::array();
  for (const OtherDelay& each : delays) {
    out.push_back({{"tau_s", each.tau_s}, {"nats_below", each.nats_below}});
  }
  return out;
}

Json NoiseJson(const FittedLoop& loop) {
  Json noise = Json::array();
  for (const FittedNoise& source : loop.noise) {
    noise.push_back({{"source", LoopNoiseName(source.source)},
                     {"frequency_hz", source.frequency_hz},
                     {"psd", source.psd},
                     {"log_std", source.log_std}});
    if (source.ratio) noise.back()["p_over_q"] = EstimateJson(*source.ratio);
  }
  return noise;
}

Json SecondPathJson(const FittedLoop& loop) {
  if (!loop.second_path) return nullptr;
  return {{"share", EstimateJson(loop.second_path->share)},
          {"extra_s", EstimateJson(loop.second_path->extra_s)}};
}

Json SmallSignalJson(const SmallSignalLoop& small) {
  return {{"frequency_hz", EstimateJson(small.frequency_hz)},
          {"growth_rate_1_s", EstimateJson(small.growth_rate_1_s)},
          {"loop_gain", EstimateJson(small.loop_gain)}};
}

Json HalvesJson(const HalfLoops& halves) {
  Json out = Json::array();
  for (const FittedLoop& half : halves) {
    out.push_back({{"tau_s", EstimateJson(half.tau_s)},
                   {"small_signal", SmallSignalJson(half.small_signal)},
                   {"modes", ModesJson(half)}});
  }
  return out;
}

Json ScalesJson(const RecordSolution& solution) {
  Json out = Json::object();
  for (const IntervalScale& scale : solution.scales) {
    out[scale.quantity] = {{"halves", scale.halves},
                           {"factor", scale.Factor()},
                           {"experiments", scale.points},
                           {"farthest_apart", solution.names[scale.worst]}};
  }
  return out;
}

Json ExperimentJson(const RecordSolution& solution, std::size_t e) {
  const FittedLoop& loop = solution.fitted[e];
  // The keys that every solution has are those of the mode next to the cycle.
  const FittedMode& first = *std::ranges::min_element(loop.modes, {}, [&](const FittedMode& mode) {
    return std::abs(std::log(mode.omega_hz.value / loop.cycle_hz));
  });
  const SmallSignalLoop& small = loop.small_signal;
  return {{"name", solution.names[e]},
          {"phi", solution.loop.points[e].operating_parameter},
          {"omega_hz", first.omega_hz.value},
          {"xi", first.xi.value},
          {"N", first.N.value},
          {"M", nullptr},
          {"tau_s", loop.tau_s.value},
          {"loop_gain", NumberOrNull(small.loop_gain.value)},
          {"frequency_hz", loop.cycle_hz},
          {"phase_deg", std::arg(loop.transfer) * 180.0 / std::numbers::pi},
          {"gain", std::abs(loop.transfer)},
          {"tau_std_s", NumberOrNull(loop.tau_s.std)},
          {"modes", ModesJson(loop)},
          {"small_signal", SmallSignalJson(small)},
          {"delay_spread", EstimateJson(loop.delay_spread)},
          {"second_path", SecondPathJson(loop)},
          {"line_errors",
           {{"acoustics", LinesJson(loop.acoustic_lines)}, {"flame", LinesJson(loop.flame_lines)}}},
          {"other_delays", OtherDelaysJson(solution.other_delays[e])},
          {"noise", NoiseJson(loop)},
          {"halves", HalvesJson(solution.halves[e])},
          {"stuck_share", {{"p", solution.stuck[e][0]}, {"q", solution.stuck[e][1]}}},
          {"clipped_share", {{"p", solution.clipped[e]}}},
          {"log_density_left_out",
           NumberOrNull(solution.loop.tried[solution.loop.chosen].log_density[e])},
          {"converged", loop.converged}};
}

Json TriedJson(const ChosenLoop& loop) {
  Json tried = Json::array();
  for (const LoopTried& one : loop.tried) {
    tried.push_back({{"flame_input", FlameInputName(one.flame_input)},
                     {"modes", one.modes},
                     {"log_density_left_out", one.Sum()}});
  }
  return tried;
}

}  // namespace

bool RecordSolution::Converged() const {
  return std::ranges::all_of(fitted, &FittedLoop::converged);
}

Json RecordSolutionJson(const RecordSolution& solution) {
  const LoopTried& chosen = solution.loop.tried[solution.loop.chosen];
  Json experiments = Json::array();
  double cost = 0.0;
  for (std::size_t e = 0; e < solution.names.size(); ++e) {
    experiments.push_back(ExperimentJson(solution, e));
    cost -= solution.loop.fit.points[e].log_posterior;
  }
  const bool converged = solution.Converged();
  return {{"schema", "howl.solution/1"},
          {"experiments", experiments},
          {"shared", Json::object()},
          {"vanishing_phi", VanishingJson(solution.onset.at)},
          {"onset_frequency_hz", EstimateJson(solution.onset.frequency_hz)},
          {"cost", NumberOrNull(cost)},
          {"termination", converged ? "converged" : "not converged"},
          {"converged", converged},
          {"interval_scales", ScalesJson(solution)},
          {"flame_input", FlameInputName(chosen.flame_input)},
          {"modes", chosen.modes},
          {"modes_tried", TriedJson(solution.loop)}};
}

}  // namespace howl
