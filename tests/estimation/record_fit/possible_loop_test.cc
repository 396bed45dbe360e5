// The density of possible loops: its slopes, and that it vanishes where loops become impossible.
#include "estimation/record_fit/loop/possible_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "estimation/record_fit/loop/return_difference.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::possible_loop_test {
namespace {

constexpr double kStep = 1e-6;

class PossibleLoopTest : public testing::TestWithParam<std::tuple<FlameInput, DelaySpread, bool>> {
 protected:
  void SetUp() override {
    FlameInput input{};
    structure_ = FreeStructure(2);
    std::tie(input, structure_.delay_spread, structure_.second_path) = GetParam();
    record_ = MakeRecordSpectra(SimulateModalLoop(DuctOfModes(2), 0.5, 1), 203.0, input);
    parameters_ = StartsOf(record_, structure_, PriorOf(structure_, record_), 4, 1).back();
    // Near enough to every edge that each slope counts.
    parameters_[structure_.Delay()] = std::log(2.0 * LeastDelay(record_));
    const LoopTail tail(record_, At(parameters_));
    Flame() *= 0.8 / std::max(std::abs(tail.constant), std::abs(tail.u));
  }

  Eigen::VectorBlock<Eigen::VectorXd> Flame() {
    return parameters_.segment(structure_.Flame(), record_.flame.cols());
  }
  LoopPoint At(const Eigen::VectorXd& parameters) const {
    return ToPoint(structure_, record_.flame.cols(), parameters);
  }
  double Density(Eigen::Index i, double step) const {
    Eigen::VectorXd moved = parameters_;
    moved[i] += step;
    return LogDensityOfPossible(record_, At(moved));
  }

  RecordSpectra record_;
  PointStructure structure_;
  Eigen::VectorXd parameters_;
};

TEST_P(PossibleLoopTest, SlopesAreThoseOfTheDensity) {
  ASSERT_TRUE(IsPossible(record_, At(parameters_)));
  const Eigen::VectorXd slopes = GradientOfPossible(record_, structure_, At(parameters_));
  ASSERT_EQ(slopes.size(), structure_.FlameLine(record_.flame.cols()));
  for (Eigen::Index i = 0; i < slopes.size(); ++i) {
    const double slope = (Density(i, kStep) - Density(i, -kStep)) / (2.0 * kStep);
    EXPECT_NEAR(slopes[i], slope, 1e-6 * (1.0 + std::abs(slope))) << "parameter " << i;
  }
}

// Along the flame's strength every x but that of the delay is proportional: with it alone
// - d^2 ln(1 - x^2) / d (ln x)^2 = 4 x^2 / (1 - x^2)^2 is the information.
TEST_P(PossibleLoopTest, InformationIsTheCurvatureAlongTheFlamesStrength) {
  const Eigen::MatrixXd information = InformationOfPossible(record_, structure_, At(parameters_));
  Eigen::VectorXd strength = Eigen::VectorXd::Zero(information.rows());
  strength.tail(record_.flame.cols()) = Flame();
  const auto density = [&](double log_strength) {
    Eigen::VectorXd moved = parameters_;
    moved.segment(structure_.Flame(), record_.flame.cols()) *= std::exp(log_strength);
    return LogDensityOfPossible(record_, At(moved));
  };
  constexpr double kWide = 1e-4;
  const double curvature =
      (2.0 * density(0.0) - density(kWide) - density(-kWide)) / (kWide * kWide);
  EXPECT_NEAR(strength.dot(information * strength), curvature, 1e-4 * curvature);
}

TEST_P(PossibleLoopTest, VanishesAtTheEdgeOfWhatTheDeterminantAllows) {
  const LoopTail tail(record_, At(parameters_));
  const double to_edge = 1.0 / std::max(std::abs(tail.constant), std::abs(tail.u));
  Flame() *= to_edge * (1.0 - 1e-9);
  EXPECT_TRUE(std::isfinite(LogDeterminant(record_, At(parameters_))));
  EXPECT_LT(LogDensityOfPossible(record_, At(parameters_)), -15.0);
  Flame() *= 1.0 + 2e-9;
  EXPECT_FALSE(std::isfinite(LogDeterminant(record_, At(parameters_))));
}

INSTANTIATE_TEST_SUITE_P(
    AllInputsAndPaths, PossibleLoopTest,
    testing::Combine(testing::Values(FlameInput::kPressureRate, FlameInput::kPressure,
                                     FlameInput::kVelocity),
                     testing::Values(DelaySpread::kNone, DelaySpread::kNormal, DelaySpread::kGamma),
                     testing::Bool()));

}  // namespace
}  // namespace howl::possible_loop_test
