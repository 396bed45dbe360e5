#include "app/simulate/simulate_start.h"

#include <algorithm>
#include <cmath>

#include "app/text/text_table.h"
#include "io/user_error.h"
#include "model/cycles/floquet.h"

namespace howl {
namespace {

// A start is meant for one cycle: another one's frequency lies farther off.
constexpr double kNearEnough = 0.2;

std::string Frequencies(const std::vector<LimitCycle>& cycles) {
  if (cycles.empty()) return "none";
  std::string text;
  for (const LimitCycle& cycle : cycles) {
    text += (text.empty() ? "" : ", ") + Fixed(cycle.frequency_hz, 1);
  }
  return text + " Hz";
}

const LimitCycle* Nearest(const std::vector<LimitCycle>& cycles, double frequency_hz) {
  const auto nearest = std::ranges::min_element(cycles, {}, [&](const LimitCycle& cycle) {
    return std::abs(cycle.frequency_hz - frequency_hz);
  });
  return nearest == cycles.end() ? nullptr : &*nearest;
}

SimulationOrigin OnCycle(const ClosedLoop& model, const LimitCycle& cycle) {
  const bool attracts = CycleStability(model, cycle).stable;
  return {cycle, "on the cycle at " + Fixed(cycle.frequency_hz, 1) + " Hz" +
                     (attracts ? "" : ", which does not attract")};
}

}  // namespace

std::optional<LimitCycle> ObservedCycle(const ClosedLoop& model, double frequency_hz) {
  const std::vector<LimitCycle> cycles = LimitCycles(model, 2.0 * frequency_hz);
  const LimitCycle* const nearest = Nearest(cycles, frequency_hz);
  return nearest == nullptr ? std::nullopt : std::optional(*nearest);
}

std::vector<LimitCycle> CyclesOfInterest(const ClosedLoop& model, double frequency_hz) {
  const Acoustics<double>& acoustics = model.loop.acoustics;
  const double highest_mode_hz =
      acoustics.omega_hz * (acoustics.M > 0.0 ? acoustics.harmonic_ratio : 1.0);
  return LimitCycles(model, 2.0 * std::max(frequency_hz, highest_mode_hz));
}

SimulationOrigin FindOrigin(const Config& config, const Experiment& experiment,
                            const ClosedLoop& model, const std::optional<LimitCycle>& observed) {
  const SimulationSpec& spec = config.simulation;
  if (!spec.start_frequency_hz && spec.start == SimulationStart::kRest) {
    return {std::nullopt, "at rest"};
  }
  if (!spec.start_frequency_hz && spec.start == SimulationStart::kObservedCycle) {
    if (!observed) return {std::nullopt, "at rest"};
    return OnCycle(model, *observed);
  }
  const double wanted_hz = spec.start_frequency_hz.value_or(experiment.frequency_hz);
  const std::vector<LimitCycle> cycles = CyclesOfInterest(model, wanted_hz);
  const auto fail = [&](const char* key, const std::string& what) {
    throw UserError(config.source.string(), spec.start_line, key,
                    what + "; the cycles of " + experiment.name + " are: " + Frequencies(cycles));
  };
  const LimitCycle* chosen = nullptr;
  if (spec.start_frequency_hz) {
    chosen = Nearest(cycles, wanted_hz);
    if (chosen == nullptr || std::abs(chosen->frequency_hz - wanted_hz) > kNearEnough * wanted_hz) {
      fail("simulate.start_frequency_hz", "no cycle near " + Fixed(wanted_hz, 1) +
                                              " Hz, expected the frequency of one to within 20 %");
    }
  } else {
    for (const LimitCycle& cycle : cycles) {
      const bool above = !observed || cycle.frequency_hz > 1.001 * observed->frequency_hz;
      if (above && CycleStability(model, cycle).stable) chosen = &cycle;
    }
    if (chosen == nullptr) {
      fail("simulate.start", "no cycle above the observed one attracts, expected observed or rest");
    }
  }
  return OnCycle(model, *chosen);
}

}  // namespace howl
