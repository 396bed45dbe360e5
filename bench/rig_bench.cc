// What one operating point of a trial's case costs: 16 000 samples at 5 kHz and a second to settle.
#include <benchmark/benchmark.h>

#include <cmath>

#include "rig/plan.h"
#include "rig/recording.h"

namespace rig {
namespace {

Spec OnePoint(const char* effect) {
  Spec spec;
  spec.experiments = {{"exp1", 0.56, 212.0, -8.0, 12.0}};
  if (effect != nullptr) spec.effects.push_back({effect, 0.55, std::nullopt});
  return spec;
}

void Design(benchmark::State& state) {
  const Plan plan = MakePlan(OnePoint(nullptr));
  for (auto _ : state) benchmark::DoNotOptimize(DesignDuct(plan.points[0].modes, 5e-5));
}
BENCHMARK(Design)->Unit(benchmark::kMillisecond);

void Point(benchmark::State& state, const char* effect) {
  const Spec spec = OnePoint(effect);
  const Plan plan = MakePlan(spec);
  const Grid grid = MakeGrid(plan, spec.sampling_hz, 1);
  const auto samples = static_cast<std::size_t>(std::lround(spec.duration_s * spec.sampling_hz));
  const auto settle = static_cast<std::size_t>(spec.settle_s / grid.step_s);
  for (auto _ : state) {
    const TrueSignals signals =
        March(plan, 0, grid, settle, samples * grid.per_sample + 2 * LeadSteps(plan, grid), 1);
    benchmark::DoNotOptimize(Digitise(plan, 0, grid, signals, samples, spec.sampling_hz, 1));
  }
}
BENCHMARK_CAPTURE(Point, base, nullptr)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Point, moving_delay, "amplitude_dependent_delay")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Point, moving_duct, "slow_drift")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rig
