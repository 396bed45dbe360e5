// Enumeration, sampling and bounds of the unfalsified family of test R228.
#include <benchmark/benchmark.h>

#include "estimation/family/enumerate.h"
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

}  // namespace
}  // namespace howl
