#include "model/numerics/parallel_for.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace howl::parallel_for_test {
namespace {

constexpr std::size_t kUnits = 200;

// What a unit leaves is seen by the caller without a lock, and what the caller left by the unit.
TEST(ParallelFor, RunsEachUnitOnceOnAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 5}) {
    std::vector<int> runs(kUnits, 1);
    ParallelFor(kUnits, threads, [&](std::size_t i) { runs[i] += static_cast<int>(i); });
    for (std::size_t i = 0; i < kUnits; ++i) EXPECT_EQ(runs[i], static_cast<int>(i) + 1) << threads;
  }
  ParallelFor(0, 3, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, AnExceptionOfAUnitIsTheCallersOnAnyNumberOfThreads) {
  for (const int threads : {1, 3}) {
    const auto unit = [](std::size_t i) {
      if (i == 7) throw std::runtime_error("unit 7");
    };
    EXPECT_THROW(ParallelFor(kUnits, threads, unit), std::runtime_error);
  }
}

TEST(ParallelFor, UnitsRunUnitsOfTheirOwnOnTheCallersThreads) {
  std::vector<std::vector<int>> runs(8, std::vector<int>(8, 0));
  ParallelFor(8, 2, [&](std::size_t i) { ParallelFor(8, [&](std::size_t k) { ++runs[i][k]; }); });
  for (const std::vector<int>& row : runs) {
    for (const int count : row) EXPECT_EQ(count, 1);
  }
}

// libtbb warns on standard error, once a process, where more is asked of it than it has.
TEST(ParallelForDeathTest, SaysNothingWhereTheProcessHasOneCore) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto on_one_core = [] {
    cpu_set_t all;
    cpu_set_t one;
    sched_getaffinity(0, sizeof all, &all);
    CPU_ZERO(&one);
    for (int core = 0; CPU_COUNT(&one) == 0; ++core) {
      if (CPU_ISSET(core, &all)) CPU_SET(core, &one);
    }
    sched_setaffinity(0, sizeof one, &one);
    ParallelFor(kUnits, 4, [](std::size_t) {});
    std::exit(0);
  };
  EXPECT_EXIT(on_one_core(), testing::ExitedWithCode(0), testing::Eq(""));
}

}  // namespace
}  // namespace howl::parallel_for_test
