// What a flame's gain that fluctuates makes of the cycle's lines, and what it does not.
#include "diagnosis/loop_budget/account/lines_of_gain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::lines_of_gain_test {
namespace {

// Whose cycle is louder while the gain is large.
std::vector<LoopRecord> DuctsOfGain(double gain_rms, double memory_s, double duration_s,
                                    const ModalInstruments& instruments = {}) {
  std::vector<LoopRecord> out;
  for (const double gain : {1.2, 1.5, 1.8}) {
    out.push_back(DuctAt(gain, duration_s, static_cast<std::uint64_t>(100.0 * gain), instruments,
                         [&](ModalLoop* loop) {
                           loop->gain_rms = gain_rms;
                           loop->gain_memory_s = memory_s;
                         }));
  }
  return out;
}

LoopDiagnosis Found(const std::vector<LoopRecord>& records) {
  return DiagnoseLoops(records, DuctsForm(), Among({"parametric_noise", "flame_line_errors"}));
}

TEST(LongLinesOfGain, OfAStrongGainAreItsOwn) {
  const LoopDiagnosis found = Found(DuctsOfGain(0.35, 0.1, 6.0));
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kEffect);
  EXPECT_EQ(found.diagnosis.effect, "parametric_noise");
  EXPECT_GT(found.flame.nats, 10.0);
  EXPECT_TRUE(found.flame.AreOfGain());
}

// A share of p^3 in q, beside a gain that fluctuates little.
TEST(LinesOfGain, OfWhatElseBendsQAreNot) {
  const LoopDiagnosis found = Found(DuctsOfGain(0.1, 0.02, 0.8, [](Record* record) {
    const double p = RootMeanSquare(record->pressure);
    const double q = RootMeanSquare(record->heat_release);
    for (std::size_t i = 0; i < record->pressure.size(); ++i) {
      record->heat_release[i] += 0.1 * q * std::pow(record->pressure[i] / p, 3);
    }
  }));
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kUnknown);
  EXPECT_GT(found.flame.of_gain.bound, 0.0);
  EXPECT_FALSE(found.flame.AreOfGain());
}

TEST(LinesOfGain, AreNoneWithoutSuchAGain) {
  const LoopDiagnosis found = Found(DuctsOfGain(0.0, 0.02, 0.8));
  EXPECT_EQ(found.diagnosis.kind, VerdictKind::kNone);
  EXPECT_EQ(found.flame.of_gain.bound, 0.0);
  EXPECT_FALSE(found.flame.AreOfGain());
}

}  // namespace
}  // namespace howl::lines_of_gain_test
