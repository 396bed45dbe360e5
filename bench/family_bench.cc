// Enumeration, sampling and bounds of the unfalsified family of test R228.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "bench/r228_family.h"
#include "estimation/family/answers/tradeoff.h"
#include "estimation/family/bounds/enclose.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/sample.h"
#include "tests/r228.h"

namespace howl {
namespace {

FamilyProblem Problem(int modes) {
  FamilyProblem problem;
  problem.experiments = R228();
  problem.model.modes = modes;
  return problem;
}

// Members a second, enumerated and tested on one core (items_per_second).
void BM_Enumerate(benchmark::State& state) {
  const FamilyProblem problem = Problem(static_cast<int>(state.range(0)));
  constexpr std::size_t kCount = 20000;
  std::size_t members = 0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    const Enumeration enumeration = EnumerateMembers(problem, kCount, ++seed, 1);
    members += enumeration.members.size();
    benchmark::DoNotOptimize(enumeration.members.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(members));
}
BENCHMARK(BM_Enumerate)->ArgName("modes")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

// Guaranteed bounds of all parameters on two cores; excess: the largest (outer - inner) / inner.
void BM_Enclose(benchmark::State& state) {
  const FamilyProblem problem = Problem(1);
  double excess = 0.0;
  for (auto _ : state) {
    Enclosure enclosure(problem, {.width = 0.01, .threads = 2});
    enclosure.Run();
    for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
      for (const FamilyParameter parameter : kFamilyParameters) {
        if (!enclosure.IsBounded(i, parameter)) continue;
        excess = std::max(excess, enclosure.Bound(i, parameter).Excess());
      }
    }
  }
  state.counters["excess"] = excess;
}
BENCHMARK(BM_Enclose)->Unit(benchmark::kMillisecond)->UseRealTime();

// The same with two modes, shared M, and the line near 750 Hz: configs/r228_two_modes.yaml.
void BM_EncloseTwoModes(benchmark::State& state) {
  const FamilyProblem problem = R228Family(2);
  double excess = 0.0;
  for (auto _ : state) {
    Enclosure enclosure(problem, {.width = 0.01, .threads = 2});
    enclosure.Run();
    for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
      for (const FamilyParameter parameter : kFamilyParameters) {
        excess = std::max(excess, enclosure.Bound(i, parameter).Excess());
      }
    }
  }
  state.counters["excess"] = excess;
}
BENCHMARK(BM_EncloseTwoModes)->Unit(benchmark::kMillisecond)->UseRealTime();

// Ten thousand uniform members; effective members a second.
void BM_Sample(benchmark::State& state) {
  const FamilyProblem problem = Problem(1);
  double effective = 0.0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    const MemberSample sample = SampleMembers(
        problem, {.count = 10000, .seed = ++seed, .threads = static_cast<int>(state.range(0))});
    effective += sample.diagnostics.effective_sample_size;
  }
  state.counters["effective_per_s"] = benchmark::Counter(effective, benchmark::Counter::kIsRate);
}
BENCHMARK(BM_Sample)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_Tradeoff(benchmark::State& state) {
  const FamilyProblem problem = Problem(1);
  const std::vector<double> spreads = DefaultSpreads(problem);
  for (auto _ : state) {
    benchmark::DoNotOptimize(ComputeTradeoff(problem, spreads).data());
  }
}
BENCHMARK(BM_Tradeoff)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace howl
