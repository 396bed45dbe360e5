// Time of each analysis of one loop: the paper's, two modes, M/N = 0.6, up to 2 kHz.
#include <benchmark/benchmark.h>

#include "model/cycles/continuation.h"
#include "model/cycles/floquet.h"
#include "model/cycles/harmonic_balance.h"
#include "model/loop/crossings.h"
#include "model/loop/poles.h"

namespace {

howl::ClosedLoop Loop(double m_over_n) {
  return {{{215.0, 0.2, 6609.0, 6609.0 * m_over_n, 3.0}, 0.00346},
          {howl::FlameShape::kTanh, -0.703e-4, 0.5, 0.0}};
}

void PhaseCrossings(benchmark::State& state) {
  const howl::ClosedLoop model = Loop(0.6);
  for (auto _ : state) {
    benchmark::DoNotOptimize(howl::PhaseCrossings(model.loop, model.flame.slope, 2000.0));
  }
}
BENCHMARK(PhaseCrossings)->Unit(benchmark::kMicrosecond);

void ClosedLoopPoles(benchmark::State& state) {
  const howl::ClosedLoop model = Loop(0.6);
  for (auto _ : state) {
    benchmark::DoNotOptimize(howl::ClosedLoopPoles(model.loop, model.flame.slope));
  }
}
BENCHMARK(ClosedLoopPoles)->Unit(benchmark::kMicrosecond);

void LimitCycles(benchmark::State& state) {
  const howl::ClosedLoop model = Loop(0.6);
  for (auto _ : state) benchmark::DoNotOptimize(howl::LimitCycles(model, 900.0));
}
BENCHMARK(LimitCycles)->Unit(benchmark::kMicrosecond);

void CycleStability(benchmark::State& state) {
  const howl::ClosedLoop model = Loop(0.6);
  const auto cycles = howl::LimitCycles(model, 900.0);
  for (auto _ : state) {
    for (const auto& cycle : cycles) {
      benchmark::DoNotOptimize(howl::CycleStability(model, cycle));
    }
  }
}
BENCHMARK(CycleStability)->Unit(benchmark::kMicrosecond);

void ContinueCycle(benchmark::State& state) {
  howl::ContinuationOptions options;
  options.parameter_min = 0.2;
  options.parameter_max = 1.0;
  const auto cycles = howl::LimitCycles(Loop(0.6), 900.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(howl::ContinueCycle(Loop, 0.6, cycles.front(), options));
  }
}
BENCHMARK(ContinueCycle)->Unit(benchmark::kMillisecond);

}  // namespace
