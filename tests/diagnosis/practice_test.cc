// Rigs from a simulator that shares no code with this one; their folder tells what was withheld.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>

#include "diagnosis/diagnosis.h"
#include "tests/practice_records.h"

namespace howl::practice_test {
namespace {

std::string CaseName(int number) {
  char text[16];
  std::snprintf(text, sizeof(text), "case%03d", number);
  return text;
}

std::vector<DiagnosisExperiment> ReadCase(const std::string& folder) {
  std::vector<DiagnosisExperiment> out;
  for (NamedRecord& each : PracticeRecords(folder)) {
    out.push_back({each.name, each.phi, std::move(each.record)});
  }
  return out;
}

std::string ReadEffect(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::string key = "\"effect\": \"";
  const std::size_t from = line.find(key);
  if (from == std::string::npos) return "";
  return line.substr(from + key.size(), line.find('"', from + key.size()) - from - key.size());
}

enum class Score : std::uint8_t { kRight, kClass, kWrong };

Score Judge(const std::string& truth, const Diagnosis& diagnosis) {
  const bool outside = truth.starts_with("x_");
  if (truth == "none") {
    return diagnosis.kind == VerdictKind::kNone ? Score::kRight : Score::kWrong;
  }
  if (outside) return diagnosis.kind == VerdictKind::kUnknown ? Score::kRight : Score::kWrong;
  if (diagnosis.kind != VerdictKind::kEffect) return Score::kWrong;
  if (diagnosis.effect == truth) return Score::kRight;
  const auto& others = diagnosis.indistinguishable;
  const bool named = std::find(others.begin(), others.end(), truth) != others.end();
  return named && others.size() <= 2 ? Score::kClass : Score::kWrong;
}

TEST(LongPractice, ANullAndASkew) {
  const char* folder = std::getenv("HOWL_PRACTICE");
  if (!folder) GTEST_SKIP() << "HOWL_PRACTICE is not set";
  for (const int number : {2, 3}) {
    const std::string path = std::string(folder) + "/" + CaseName(number);
    const std::string truth = ReadEffect(path + ".truth.json");
    ASSERT_FALSE(truth.empty());
    EXPECT_EQ(Judge(truth, Diagnose(ReadCase(path), {})), Score::kRight) << truth;
  }
}

// Takes minutes: run by the test with the label `long`.
TEST(Practice, DISABLED_AllCases) {
  const char* folder = std::getenv("HOWL_PRACTICE");
  if (!folder) GTEST_SKIP() << "HOWL_PRACTICE is not set";
  int named = 0;
  int accused = 0;
  int outside_unknown = 0;
  for (int number = 1; number <= 25; ++number) {
    const std::string path = std::string(folder) + "/" + CaseName(number);
    const std::string truth = ReadEffect(path + ".truth.json");
    ASSERT_FALSE(truth.empty());
    const Diagnosis diagnosis = Diagnose(ReadCase(path), {});
    const Score score = Judge(truth, diagnosis);
    const bool good = score != Score::kWrong;
    if (truth == "none") {
      accused += good ? 0 : 1;
    } else if (truth.starts_with("x_")) {
      outside_unknown += good ? 1 : 0;
    } else {
      named += good ? 1 : 0;
    }
    std::printf("%-28s %-8s %-26s gap %.3f -> %.3f %s\n", truth.c_str(),
                diagnosis.kind == VerdictKind::kNone      ? "none"
                : diagnosis.kind == VerdictKind::kUnknown ? "unknown"
                                                          : "effect",
                diagnosis.effect.c_str(), diagnosis.gap_before, diagnosis.gap_after,
                good ? "" : "MISSED");
  }
  EXPECT_GE(named, 18);
  EXPECT_EQ(accused, 0);
  EXPECT_EQ(outside_unknown, 2);
}

}  // namespace
}  // namespace howl::practice_test
