// Delay systems against closed forms and against two published computations.
#include "model/delay_systems/delay_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "model/delay_systems/hopf_point.h"

namespace howl::delay_system_test {
namespace {

// x'(t) = -lambda x(t - 1)
DelaySystem Scalar() {
  return {1, {1.0}, [](double lambda, const auto& /*x*/, auto delayed, Eigen::VectorXd* rate) {
            *rate = -lambda * delayed[0];
          }};
}

// With x = 1 up to time zero and lambda = 1, by the method of steps
// x(t) = sum_k (-1)^k (t - k + 1)^k / k! over k with t > k - 1.
double ByMethodOfSteps(double t) {
  double sum = 1.0, factorial = 1.0;
  for (int k = 1; k - 1 < t; ++k) {
    factorial *= k;
    sum += (k % 2 == 0 ? 1.0 : -1.0) * std::pow(t - k + 1, k) / factorial;
  }
  return sum;
}

TEST(DelayTrajectory, IsOfOrderFour) {
  const auto error = [](double step) {
    DelayTrajectory x(Scalar(), Eigen::VectorXd::Ones(1), step);
    x.Continue(Scalar(), 1.0, 8.0);
    return std::abs(x.last()(0) - ByMethodOfSteps(8.0));
  };
  const double coarse = error(0.1), fine = error(0.05), finest = error(0.025);
  EXPECT_LT(coarse, 1e-5);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.3);
  EXPECT_NEAR(std::log2(fine / finest), 4.0, 0.3);
}

TEST(DelayTrajectory, ReadsBetweenSteps) {
  DelayTrajectory x(Scalar(), Eigen::VectorXd::Ones(1), 0.01);
  x.Continue(Scalar(), 1.0, 5.0);
  for (const double t : {0.333, 1.7771, 4.2345}) {
    EXPECT_NEAR(x.At(t)(0), ByMethodOfSteps(t), 1e-8);
  }
}

// s = -lambda e^(-s) has the pair +- j pi / 2 at lambda = pi / 2, and there
// d Re s / d lambda = lambda / (1 + lambda^2).
TEST(HopfPoint, OfTheScalarEquation) {
  const auto hopf = FindHopf(Scalar(), 1.0, 2.0, Eigen::VectorXd::Zero(1));
  ASSERT_TRUE(hopf);
  const double half_pi = 0.5 * std::numbers::pi;
  EXPECT_NEAR(hopf->parameter, half_pi, 1e-9);
  EXPECT_NEAR(hopf->omega, half_pi, 1e-9);
  EXPECT_NEAR(hopf->crossing_rate, half_pi / (1.0 + half_pi * half_pi), 1e-6);
  // At lambda = 1 / e the rightmost root is the double one at -1; beyond, a pair.
  const auto roots = CharacteristicRoots(Scalar(), 1.0, Eigen::VectorXd::Zero(1));
  // s = -0.318131505 +- 1.337235701 j: Lambert's W of -1.
  EXPECT_NEAR(roots[0].real(), -0.318131505, 1e-8);
  EXPECT_NEAR(std::abs(roots[0].imag()), 1.337235701, 1e-8);
  EXPECT_FALSE(FindHopf(Scalar(), 0.5, 1.0, Eigen::VectorXd::Zero(1)));
}

// Two neurons (L. P. Shayer and S. A. Campbell, SIAM J. Appl. Math. 61:673, 2000), the demo
// "neuron" of DDE-BIFTOOL: kappa 0.5, beta -1, a12 1, tau_1 = tau_2 = 0.2, tau_s = 1.5; a21 moves.
// Its documentation has the Hopf point at a21 0.807123, omega 0.781965.
DelaySystem Neurons() {
  return {2, {0.2, 1.5}, [](double a21, const auto& x, auto delayed, Eigen::VectorXd* rate) {
            const auto& fast = delayed[0];
            const auto& own = delayed[1];
            (*rate)(0) = -0.5 * x(0) - std::tanh(own(0)) + std::tanh(fast(1));
            (*rate)(1) = -0.5 * x(1) - std::tanh(own(1)) + a21 * std::tanh(fast(0));
          }};
}

TEST(HopfPoint, OfTheNeuronDemo) {
  const auto hopf = FindHopf(Neurons(), 0.5, 1.2, Eigen::VectorXd::Zero(2));
  ASSERT_TRUE(hopf);
  EXPECT_NEAR(hopf->parameter, 0.807123, 1e-6);
  EXPECT_NEAR(hopf->omega, 0.781965, 1e-6);
}

// The cycle beyond the Hopf point begins at its frequency, with an amplitude that grows out of
// nothing: A^2 is in proportion to the distance, to first order.
TEST(HopfPoint, TheNeuronsCycleGrowsOutOfIt) {
  const Eigen::VectorXd first = Eigen::Vector2d(1.0, 0.0);
  const auto hopf = FindHopf(Neurons(), 0.5, 1.2, Eigen::VectorXd::Zero(2));
  ASSERT_TRUE(hopf);
  std::vector<double> squares;
  for (const double beyond : {0.002, 0.001}) {
    DelayTrajectory x(Neurons(), Eigen::Vector2d(0.05, -0.05), 0.1);
    const double e_folding = 1.0 / (hopf->crossing_rate * beyond);
    x.Continue(Neurons(), hopf->parameter + beyond, 12.0 * e_folding);
    const auto period = x.Period(first, 10);
    ASSERT_TRUE(period);
    EXPECT_NEAR(2.0 * std::numbers::pi / *period, hopf->omega, 0.002);
    squares.push_back(std::pow(x.Amplitude(first, 100.0), 2));
  }
  EXPECT_NEAR(squares[0] / squares[1], 2.0, 0.1);
}

// The delayed Rijke tube with King's law of github.com/csskene/phase-reduction_Rijke-tube (C. S.
// Skene and K. Taira, J. Fluid Mech. 933:A35, 2022): modes eta_i with u = sum eta_i cos(i pi x),
//
//   eta_i'' + (c_1 i^2 + c_2 sqrt(i)) eta_i' + (i pi)^2 eta_i
//       = -i pi K (sqrt|1/3 + u_f(t - tau)| - sqrt(1/3)) sin(i pi x_f)
//
// c_1 0.1, c_2 0.06, x_f 0.25, tau 0.2; K moves.
DelaySystem RijkeTube(int modes) {
  return {2 * modes, {0.2}, [modes](double k, const auto& x, auto delayed, Eigen::VectorXd* rate) {
            const double pi = std::numbers::pi;
            double u = 0.0;
            for (int i = 1; i <= modes; ++i) u += delayed[0](i - 1) * std::cos(i * pi * 0.25);
            const double heat = k * (std::sqrt(std::abs(1.0 / 3.0 + u)) - std::sqrt(1.0 / 3.0));
            for (int i = 1; i <= modes; ++i) {
              const double damping = 0.1 * i * i + 0.06 * std::sqrt(i);
              (*rate)(i - 1) = x(modes + i - 1);
              (*rate)(modes + i - 1) = -i * i * pi * pi * x(i - 1) - damping * x(modes + i - 1) -
                                       i * pi * heat * std::sin(i * pi * 0.25);
            }
          }};
}

// u at the heater.
Eigen::VectorXd HeaterVelocity(int modes) {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(Eigen::Index{2} * modes);
  for (int i = 1; i <= modes; ++i) c(i - 1) = std::cos(i * std::numbers::pi * 0.25);
  return c;
}

TEST(HopfPoint, OfTheRijkeTube) {
  const auto ten = FindHopf(RijkeTube(10), 0.5, 0.7, Eigen::VectorXd::Zero(20));
  ASSERT_TRUE(ten);
  EXPECT_NEAR(ten->parameter, 0.614279, 1e-6);
  EXPECT_NEAR(ten->omega, 3.246276, 1e-6);
  EXPECT_GT(ten->crossing_rate, 0.0);
  const auto one = FindHopf(RijkeTube(1), 0.5, 0.7, Eigen::VectorXd::Zero(2));
  ASSERT_TRUE(one);
  EXPECT_NEAR(one->parameter, 0.631593, 1e-6);
}

class RijkeCycle : public testing::Test {
 protected:
  static DelayTrajectory OnCycle(double k, double step) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(20);
    start(0) = 0.5;
    DelayTrajectory x(RijkeTube(10), start, step);
    x.Continue(RijkeTube(10), k, 300.0);
    return x;
  }
};

TEST_F(RijkeCycle, HasThePublishedPeriod) {
  // The root of King's law has a cusp, where the scheme loses order: two steps show what is left.
  const auto coarse = OnCycle(0.72, 0.01).Period(HeaterVelocity(10), 20);
  const auto fine = OnCycle(0.72, 0.005).Period(HeaterVelocity(10), 20);
  ASSERT_TRUE(coarse && fine);
  EXPECT_NEAR(*fine, 1.93356, 1e-5);
  EXPECT_NEAR(*coarse, *fine, 1e-4);
}

// Subcritical: below the Hopf point rest attracts, and so does the cycle, down to a fold.
TEST_F(RijkeCycle, OutlivesTheHopfPointDownToAFold) {
  const Eigen::VectorXd u = HeaterVelocity(10);
  // Rest: small motions decay at the rate of the rightmost root.
  const double decay =
      CharacteristicRoots(RijkeTube(10), 0.60, Eigen::VectorXd::Zero(20)).front().real();
  EXPECT_LT(decay, 0.0);
  Eigen::VectorXd small = Eigen::VectorXd::Zero(20);
  small(0) = 1e-4;
  DelayTrajectory rest(RijkeTube(10), small, 0.01);
  rest.Continue(RijkeTube(10), 0.60, 200.0);
  const double before = rest.Amplitude(u, 10.0);
  rest.Continue(RijkeTube(10), 0.60, 400.0);
  EXPECT_NEAR(std::log(rest.Amplitude(u, 10.0) / before) / 400.0, decay, 0.02 * std::abs(decay));
  DelayTrajectory x = OnCycle(0.72, 0.01);
  for (const double k : {0.66, 0.60, 0.56, 0.54, 0.53, 0.52}) {
    x.Continue(RijkeTube(10), k, 150.0);
    EXPECT_GT(x.Amplitude(u, 10.0), 0.2) << k;
  }
  x.Continue(RijkeTube(10), 0.52, 600.0);
  EXPECT_GT(x.Amplitude(u, 10.0), 0.2);
  x.Continue(RijkeTube(10), 0.51, 600.0);
  EXPECT_LT(x.Amplitude(u, 10.0), 0.01);
}

}  // namespace
}  // namespace howl::delay_system_test
