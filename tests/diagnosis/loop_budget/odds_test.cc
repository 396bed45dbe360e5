// What an effect leaves that has not quite the form of its item.
#include "diagnosis/loop_budget/forms/odds.h"

#include <gtest/gtest.h>

#include <complex>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"
#include "tests/diagnosis/loop_budget/duct_rig.h"

namespace howl::odds_test {
namespace {

// A low-pass of q with a further pole at so many times its cutoff.
std::vector<LoopRecord> DuctsBehindLowPass(double further_pole) {
  std::vector<LoopRecord> out = DuctsAt({1.2, 1.5, 1.8});
  const auto response = [&](double hz) {
    const std::complex<double> x(0.0, hz / 400.0);
    return 1.0 / ((1.0 + x) * (1.0 + x / further_pole));
  };
  for (LoopRecord& each : out) {
    Filter(response, each.record.sampling_hz, &each.record.heat_release);
  }
  return out;
}

std::string NamedOf(double further_pole) {
  return DiagnoseLoops(DuctsBehindLowPass(further_pole), DuctsForm(),
                       Among({"q_sensor_lowpass", "channel_skew", "q_sensor_noise"}))
      .diagnosis.effect;
}

// Far off, the further pole is what errors of a form are; near, it is a delay of its own.
TEST(LongFormErrors, AreNoFurtherCause) {
  EXPECT_EQ(NamedOf(40.0), "q_sensor_lowpass");
  EXPECT_EQ(NamedOf(10.0), "q_sensor_lowpass+channel_skew");
}

}  // namespace
}  // namespace howl::odds_test
