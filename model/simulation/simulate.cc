#include "model/simulation/simulate.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "model/cycles/harmonic_balance.h"
#include "model/numerics/parallel_for.h"
#include "model/simulation/cycle_scale.h"
#include "model/simulation/lane_group.h"

namespace howl {
namespace {

constexpr double kMinInternalHz = 20000.0;  // of a first mode at the paper's 220 Hz
constexpr double kDelaySteps = 48.0;

}  // namespace

double InternalRate(const RigParameters& rig, double sampling_hz) {
  const double tau_s = rig.model.loop.tau_s;
  double shortest_s = tau_s;
  for (const auto& effect : rig.effects) {
    shortest_s = std::min(shortest_s, effect->ShortestDelay(tau_s));
  }
  const double scale = CycleScale(rig.model.loop.acoustics.omega_hz);
  const double least = std::max(kMinInternalHz * scale, kDelaySteps / shortest_s);
  return sampling_hz * std::max(1.0, std::ceil(least / sampling_hz - 1e-9));
}

std::vector<SimulatedRecord> SimulateBatch(std::span<const SimulationCase> cases,
                                           const SimulationOptions& options) {
  CHECK_GT(options.sampling_hz, 0.0);
  CHECK_GE(options.settle_s, 0.0);
  CHECK(options.internal_hz == 0.0 ||
        std::abs(std::remainder(options.internal_hz, options.sampling_hz)) <
            1e-9 * options.sampling_hz)
      << "internal rate " << options.internal_hz << " Hz is no multiple of " << options.sampling_hz
      << " Hz";
  std::vector<SimulatedRecord> records(cases.size());

  // Neighbours in lanes must share what the inner loops branch on.
  struct Key {
    double internal_hz;
    bool alone;
    int modes;
    FlameShape shape;
    std::size_t index;
  };
  std::vector<Key> order;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const RigParameters& rig = cases[i].rig;
    CHECK_GT(rig.model.loop.tau_s, 0.0);
    CHECK_GT(rig.model.flame.saturation, 0.0);
    order.push_back(
        {options.internal_hz > 0.0 ? options.internal_hz : InternalRate(rig, options.sampling_hz),
         !rig.effects.empty(), internal::NumModes(rig), rig.model.flame.shape, i});
  }
  const auto group = [](const Key& k) {
    return std::tuple(k.internal_hz, k.alone, k.modes, k.shape);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const Key& a, const Key& b) { return group(a) < group(b); });
  struct Unit {
    std::size_t begin;
    std::size_t end;
  };
  std::vector<Unit> units;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool joins = !units.empty() && !order[i].alone &&
                       group(order[units.back().begin]) == group(order[i]) &&
                       i - units.back().begin < internal::kMaxLanes;
    if (joins) {
      units.back().end = i + 1;
    } else {
      units.push_back({i, i + 1});
    }
  }

  const auto run = [&](std::size_t u) {
    std::vector<const SimulationCase*> members;
    std::vector<SimulatedRecord*> results;
    for (std::size_t i = units[u].begin; i < units[u].end; ++i) {
      members.push_back(&cases[order[i].index]);
      results.push_back(&records[order[i].index]);
    }
    internal::RunLanes(members, options, order[units[u].begin].internal_hz, results);
  };
  ParallelFor(units.size(), options.threads, run);
  return records;
}

SimulatedRecord Simulate(const SimulationCase& one, const SimulationOptions& options) {
  return std::move(SimulateBatch(std::span(&one, 1), options).front());
}

std::vector<InitialWave> PastOnCycle(const LimitCycle& cycle) {
  std::vector<InitialWave> waves;
  for (std::size_t k = 0; k < cycle.heat_release.size(); ++k) {
    const std::complex<double>& q = cycle.heat_release[k];
    if (q == 0.0) continue;
    waves.push_back({std::abs(q), static_cast<double>(k) * cycle.frequency_hz, 0.0, std::arg(q)});
  }
  return waves;
}

}  // namespace howl
