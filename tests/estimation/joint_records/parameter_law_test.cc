// The law of parameters over operating points, against closed forms and drawn problems.
#include "estimation/joint_records/parameter_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/noise/random_stream.h"

namespace howl::parameter_law_test {
namespace {

ParameterEvidence Measured(double z, double value, double std) {
  const double precision = 1.0 / (std * std);
  return {z, Eigen::MatrixXd::Constant(1, 1, precision),
          Eigen::VectorXd::Constant(1, precision * value)};
}

PointPrior Wide(double deviation) {
  return {Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, deviation), {}};
}

// Where every point is known exactly, mean and trend are those of least squares with the priors as
// further data, and s^2 the mean square about them, their own errors in it.
TEST(ParameterLaw, IsLeastSquaresOfWhatIsKnownExactly) {
  const std::vector<double> z = {-1.5, -0.5, 0.5, 1.5};
  const std::vector<double> u = {1.0, 1.3, 1.2, 1.6};
  std::vector<ParameterEvidence> points;
  for (std::size_t e = 0; e < z.size(); ++e) points.push_back(Measured(z[e], u[e], 1e-7));
  const ParameterLaw law = FitParameterLaw(points, Wide(10.0));
  const double square = std::pow(law.spread[0], 2);
  // Normal equations by hand: sums of 1, z^2, u and z u are 4, 5, 5.1 and 0.85.
  const double mean = (5.1 / square) / (4.0 / square + 1.0 / 100.0);
  const double trend = (0.85 / square) / (5.0 / square + 1.0 / 9.0);
  EXPECT_NEAR(law.mean[0], mean, 1e-4);
  EXPECT_NEAR(law.trend[0], trend, 1e-4);
  double squares = 1.0;  // of the prior: one degree of freedom of a tenth of its deviation
  for (std::size_t e = 0; e < z.size(); ++e) {
    const double error = 1.0 / (4.0 / square + 0.01) + z[e] * z[e] / (5.0 / square + 1.0 / 9.0);
    squares += std::pow(u[e] - mean - trend * z[e], 2) + error;
  }
  EXPECT_NEAR(square, squares / 5.0, 1e-3);
}

// Points of one rig differ by no more than rigs do.
TEST(ParameterLaw, SpreadHasTheLimitOfTheBase) {
  std::vector<ParameterEvidence> points;
  for (const double z : {-1.2, 0.1, 1.1}) points.push_back(Measured(z, 300.0 * z * z, 0.1));
  EXPECT_EQ(FitParameterLaw(points, Wide(2.0)).spread[0], 2.0);
}

TEST(ParameterLaw, GoesTowardAnotherByShares) {
  ParameterLaw from =
      FitParameterLaw({Measured(-1.0, 1.0, 0.1), Measured(1.0, 1.2, 0.1)}, Wide(1.0));
  ParameterLaw to = from;
  to.mean[0] += 0.4;
  to.trend[0] -= 0.2;
  to.spread[0] *= 4.0;
  const ParameterLaw half = from.Toward(to, Eigen::VectorXd::Constant(1, 0.5));
  EXPECT_NEAR(half.mean[0], from.mean[0] + 0.2, 1e-12);
  EXPECT_NEAR(half.trend[0], from.trend[0] - 0.1, 1e-12);
  EXPECT_NEAR(half.spread[0], 2.0 * from.spread[0], 1e-12);
  const Eigen::MatrixX2d move = from.MoveTo(to);
  EXPECT_NEAR(move(0, 0), 0.4 / to.spread[0], 1e-12);
  EXPECT_NEAR(move(0, 1), -0.2 / to.spread[0], 1e-12);
}

// A point that says nothing has what the others expect of it.
TEST(ParameterLaw, PointsThatSayNothingChangeLittle) {
  std::vector<ParameterEvidence> points;
  for (const double z : {-1.0, 0.0, 1.0}) points.push_back(Measured(z, 2.0 + 0.5 * z, 0.01));
  const ParameterLaw without = FitParameterLaw(points, Wide(1.0));
  points.push_back(Measured(0.5, 100.0, 1e6));
  const ParameterLaw with = FitParameterLaw(points, Wide(1.0));
  EXPECT_NEAR(with.mean[0], without.mean[0], 0.02);
  EXPECT_NEAR(with.trend[0], without.trend[0], 0.02);
}

// Of 400 rigs of six points each, with errors of measurement as large as the spread: the interval
// that the law gives for a seventh point holds it in 95 of 100.
TEST(ParameterLaw, PredictionsOfAnotherPointCover) {
  constexpr int kRigs = 400;
  RandomStream random(11);
  int inside = 0;
  double bias = 0.0;
  for (int rig = 0; rig < kRigs; ++rig) {
    const double mean = random.Normal();
    const double trend = 0.3 * random.Normal();
    const double spread = 0.1 / std::sqrt(std::pow(random.Normal(), 2));
    const auto truth = [&](double z) { return mean + trend * z + spread * random.Normal(); };
    std::vector<ParameterEvidence> points;
    for (const double z : {-1.4, -0.9, -0.2, 0.3, 0.8, 1.4}) {
      points.push_back(Measured(z, truth(z) + 0.1 * random.Normal(), 0.1));
    }
    const PointPrior there = FitParameterLaw(points, Wide(1.0)).PredictionAt(0.6);
    const double z = (truth(0.6) - there.mean[0]) / there.deviation[0];
    ASSERT_EQ(there.degrees[0], 7.0);
    if (std::abs(z) < 2.365) ++inside;  // Student's 0.975 quantile
    bias += z / kRigs;
  }
  // 93 to 97 %.
  EXPECT_GE(inside, 372);
  EXPECT_LE(inside, 388);
  EXPECT_LT(std::abs(bias), 0.2);
}

}  // namespace
}  // namespace howl::parameter_law_test
