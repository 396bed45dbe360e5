// A flame in a duct: Hopf points in closed form for one mode, and the published Rijke tube.
#include "model/delay_systems/duct_flame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/delay_systems/hopf_point.h"
#include "model/numerics/constants.h"

namespace howl::duct_flame_test {
namespace {

// One mode of 200 Hz; a flame with a falling slope of one.
DuctFlame OneMode(FlameDrive drive) {
  DuctFlame duct;
  duct.modes = {{200.0, 0.03, 50.0, 1.0}};
  duct.drive = drive;
  duct.flame = {FlameShape::kTanh, -1.0, 1.0, 0.0};
  return duct;
}

HopfPoint Hopf(const DuctFlame& duct) {
  const DelaySystem system = MakeDelaySystem(duct);
  const auto hopf = FindHopf(system, 0.5, 3.0, Eigen::VectorXd::Zero(system.dimension));
  EXPECT_TRUE(hopf);
  return hopf.value_or(HopfPoint{});
}

// s^2 + 2 xi w s + w^2 = -lambda N s e^(-s tau) has s = j w where e^(-j w tau) = -1, and then
// lambda N = 2 xi w.
TEST(DuctFlame, HopfOfAPressureDrivenFlame) {
  DuctFlame duct = OneMode(FlameDrive::kPressure);
  const double w = 2.0 * kPi * 200.0;
  duct.tau_s = kPi / w;
  const HopfPoint hopf = Hopf(duct);
  EXPECT_NEAR(hopf.parameter, 2.0 * 0.03 * w / 50.0, 1e-8);
  EXPECT_NEAR(hopf.omega, w, 1e-7);
}

// With w p / s in the place of p: e^(-j w tau) = -j.
TEST(DuctFlame, HopfOfAVelocityDrivenFlame) {
  DuctFlame duct = OneMode(FlameDrive::kVelocity);
  const double w = 2.0 * kPi * 200.0;
  duct.tau_s = 0.5 * kPi / w;
  const HopfPoint hopf = Hopf(duct);
  EXPECT_NEAR(hopf.parameter, 2.0 * 0.03 * w / 50.0, 1e-8);
  EXPECT_NEAR(hopf.omega, w, 1e-7);
}

// The low-pass turns by atan(w / w_c), which the delay is shorter by, and takes sqrt(1 + (w /
// w_c)^2) of the strength.
TEST(DuctFlame, HopfWithALowPass) {
  DuctFlame duct = OneMode(FlameDrive::kPressure);
  const double w = 2.0 * kPi * 200.0;
  duct.cutoff_hz = 400.0;
  duct.tau_s = (kPi - std::atan(0.5)) / w;
  const HopfPoint hopf = Hopf(duct);
  EXPECT_NEAR(hopf.parameter, 2.0 * 0.03 * w / 50.0 * std::sqrt(1.25), 1e-8);
  EXPECT_NEAR(hopf.omega, w, 1e-7);
}

// Beyond the Hopf point of a flame that softens, the describing function gives the amplitude: with
// little damping the cycle is nearly a sine, and lambda D(A) is the strength at the Hopf point.
TEST(DuctFlame, AmplitudeByTheDescribingFunction) {
  DuctFlame duct = OneMode(FlameDrive::kPressure);
  const double w = 2.0 * kPi * 200.0;
  duct.modes[0].xi = 0.005;
  duct.tau_s = kPi / w;
  const double critical = 2.0 * 0.005 * w / 50.0;
  const DelaySystem system = MakeDelaySystem(duct);
  DelayTrajectory x(system, Eigen::Vector2d(0.5, 0.5), duct.tau_s / 100.0);
  x.Continue(system, 1.3 * critical, 6.0);
  const double amplitude = x.Amplitude(DriveOf(duct), 0.05);
  EXPECT_NEAR(-1.3 * DescribingFunction(duct.flame, amplitude), 1.0, 2e-3);
}

// The Rijke tube of delay_system_test.cc in these terms: y_i = eta_i, p_i = eta_i' / (i pi).
DuctFlame RijkeTube(int modes) {
  DuctFlame duct;
  for (int i = 1; i <= modes; ++i) {
    const double damping = 0.1 * i * i + 0.06 * std::sqrt(i);
    duct.modes.push_back(
        {0.5 * i, damping / (2.0 * i * kPi), -std::sin(0.25 * i * kPi), std::cos(0.25 * i * kPi)});
  }
  duct.drive = FlameDrive::kVelocity;
  const double slope = 0.5 * std::sqrt(3.0);
  duct.flame = {FlameShape::kSquareRoot, slope, slope / 3.0, 0.0};
  duct.tau_s = 0.2;
  return duct;
}

TEST(DuctFlame, RijkeTubeHasThePublishedHopfPointAndPeriod) {
  const DuctFlame duct = RijkeTube(10);
  const DelaySystem system = MakeDelaySystem(duct);
  const auto hopf = FindHopf(system, 0.5, 0.7, Eigen::VectorXd::Zero(20));
  ASSERT_TRUE(hopf);
  EXPECT_NEAR(hopf->parameter, 0.614279, 1e-6);
  EXPECT_NEAR(hopf->omega, 3.246276, 1e-6);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(20);
  start(0) = 0.5;
  DelayTrajectory x(system, start, 0.005);
  x.Continue(system, 0.72, 300.0);
  const auto period = x.Period(DriveOf(duct), 20);
  ASSERT_TRUE(period);
  EXPECT_NEAR(*period, 1.93356, 1e-5);
}

}  // namespace
}  // namespace howl::duct_flame_test
