// Every input that is kept in tests/fuzz/corpus goes through its reader: those that fuzzing found
// to be wrong once, and those that reach most of the reader's branches.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/fuzz/target.h"

namespace howl::corpus_test {
namespace {

namespace fs = std::filesystem;

// An input is a few kB, and what it may unpack to some 64 MB.
constexpr long kMostMegabytes = 300;

// The most memory that this process has had so far.
long PeakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1000;  // kB
}

class Corpus : public testing::TestWithParam<FuzzTarget> {};

TEST_P(Corpus, IsReadOrRefusedWithinASecondAndLittleMemory) {
  const fs::path folder = fs::path(HOWL_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().name;
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().string());
    std::ifstream file(entry.path(), std::ios::binary);
    std::stringstream input;
    input << file.rdbuf();
    const long before = PeakMegabytes();
    const std::clock_t start = std::clock();  // the machine may have other work
    GetParam().run(input.str());
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(seconds, 1.0 * HOWL_TEST_SLOWNESS);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_LT(PeakMegabytes() - before, kMostMegabytes);
#endif
    ++count;
  }
  EXPECT_GE(count, 1U);
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, testing::ValuesIn(AllTargets()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace howl::corpus_test
