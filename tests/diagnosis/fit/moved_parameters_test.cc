#include "diagnosis/fit/moved_parameters.h"

#include <gtest/gtest.h>

#include "tests/diagnosis/simulated_rig.h"

namespace howl::moved_parameters_test {
namespace {

TEST(MovedParameters, TheFarthestComeFirst) {
  const std::vector<MovedParameter> moved = FarthestMoved(
      {{"still", 1.0, 1.01}, {"half", 1.0, 2.0}, {"sign", -1.0, 1.0}, {"zero", 0.0, 0.0}}, 4, 0.03);
  ASSERT_EQ(moved.size(), 2u);
  EXPECT_EQ(moved[0].name, "sign");
  EXPECT_EQ(moved[1].name, "half");
  EXPECT_EQ(FarthestMoved(moved, 1, 0.03).size(), 1u);
}

// A lag of q by 1 / (2 pi 400 Hz) is taken for delay and damping by a fit that knows of none.
TEST(MovedParameters, ALagOfQHadMovedTheDelayAndTheAcoustics) {
  const Diagnosis diagnosis = DiagnoseAmong(
      {"q_sensor_lowpass"},
      SimulateRig({std::make_shared<FirstOrderLowPass>(Channel::kHeatRelease, 400.0)}));
  ASSERT_EQ(diagnosis.effect, "q_sensor_lowpass");
  ASSERT_EQ(diagnosis.base_parameters.size(), 13u);
  const MovedParameter& tau = diagnosis.base_parameters[0];
  EXPECT_EQ(tau.name, "tau_s");
  EXPECT_NEAR(tau.with, 0.00352, 3e-5);  // the rig's own
  EXPECT_GT(tau.without, tau.with + 2e-4);
  const MovedParameter& omega = diagnosis.base_parameters[1];
  EXPECT_EQ(omega.name, "exp1.omega_hz");
  EXPECT_NEAR(omega.with, 206.0, 2.0);
  EXPECT_GT(std::abs(omega.without - 206.0), 2.0 * std::abs(omega.with - 206.0));
}

}  // namespace
}  // namespace howl::moved_parameters_test
