#include "estimation/analysis/transfer/transfer_point_residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/residual_jacobian.h"

namespace howl::transfer_point_residual_test {
namespace {

TEST(TransferPointResidual, HasExactDerivatives) {
  TransferPoint point;
  point.frequency_hz = 180.0;
  point.spread_hz = 2.0;
  point.re = 10.0;
  point.im = -7.0;
  point.variance_re = 0.5;
  point.variance_im = 0.3;
  point.covariance = 0.1;
  point.q_noise_bias = 0.2;
  const std::unique_ptr<ceres::CostFunction> cost(TransferPointResidual::CreateFull(point, {}));
  EXPECT_CORRECT_JACOBIAN(*cost, (std::vector<double>{0.7, std::log(210.0), std::log(0.1),
                                                      std::log(5e3), std::log(2e3)}));
}

// By hand: one mode at its natural frequency, G = N / (2 xi w) = 5, against H = 3j.
TEST(TransferPointResidual, IsTheWhitenedDifference) {
  TransferPoint point;
  point.frequency_hz = 100.0;
  point.im = 3.0;
  point.variance_re = 4.0;
  point.variance_im = 1.0;
  const double omega = std::log(100.0), xi = std::log(0.1);
  const double n = std::log(5.0 * 0.2 * 200.0 * M_PI), m = std::log(1e-12);
  std::unique_ptr<ceres::CostFunction> cost(TransferPointResidual::CreateFull(point, {}));
  double q_noise = 3.0;  // says nothing where q's noise was taken to be none
  const double* parameters[] = {&q_noise, &omega, &xi, &n, &m};
  double residual[2] = {NAN, NAN};
  ASSERT_TRUE(cost->Evaluate(parameters, residual, nullptr));
  EXPECT_NEAR(residual[0], 5.0 / 2.0, 1e-9);
  EXPECT_NEAR(residual[1], -3.0, 1e-9);

  // With half the bound b = 0.1 of q's power: no noise of q's own at u = 1 / k, where H was taken
  // for a tenth too large.
  point.q_noise_bias = 0.1;
  q_noise = 1.0 / kQNoiseLevelStd;
  cost.reset(TransferPointResidual::CreateFull(point, {}));
  ASSERT_TRUE(cost->Evaluate(parameters, residual, nullptr));
  EXPECT_NEAR(residual[0], 1.1 * 5.0 / 2.0, 1e-9);
  EXPECT_NEAR(residual[1], -3.0, 1e-9);
}

}  // namespace
}  // namespace howl::transfer_point_residual_test
