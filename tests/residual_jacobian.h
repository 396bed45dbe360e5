// The one check of every residual block's Jacobian: analytic against a five-point stencil, at one
// point. Names the parameter block and the residual that are wrong.
//
// Parameters are logarithms, so one step suits all. The sharpest feature is a resonance of relative
// width xi >= 0.02: with h = 2e-4 the stencil's truncation is below (h / xi)^4 = 1e-8 of the
// derivative, and its rounding about 1e-12 of the residual.
#ifndef HOWL_TESTS_RESIDUAL_JACOBIAN_H_
#define HOWL_TESTS_RESIDUAL_JACOBIAN_H_

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace howl {

inline ::testing::AssertionResult JacobianIsCorrect(const ceres::CostFunction& cost,
                                                    std::vector<double> parameters,
                                                    double tolerance = 1e-8) {
  constexpr double kStep = 2e-4;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto num_residuals = static_cast<std::size_t>(cost.num_residuals());
  std::vector<const double*> blocks;
  std::vector<std::vector<double>> analytic;
  std::size_t offset = 0;
  for (const int size : cost.parameter_block_sizes()) {
    blocks.push_back(parameters.data() + offset);
    analytic.emplace_back(num_residuals * static_cast<std::size_t>(size), nan);
    offset += static_cast<std::size_t>(size);
  }
  if (offset != parameters.size()) {
    return ::testing::AssertionFailure()
           << parameters.size() << " parameters given, " << offset << " wanted";
  }
  std::vector<double*> jacobians;
  for (std::vector<double>& block : analytic) jacobians.push_back(block.data());
  std::vector<double> residuals(num_residuals, nan);
  if (!cost.Evaluate(blocks.data(), residuals.data(), jacobians.data())) {
    return ::testing::AssertionFailure() << "the block refuses to be evaluated";
  }
  double scale = 1.0;
  for (const double residual : residuals) scale = std::max(scale, std::abs(residual));

  std::size_t column = 0;
  for (std::size_t b = 0; b < analytic.size(); ++b) {
    const std::size_t width = analytic[b].size() / num_residuals;
    for (std::size_t k = 0; k < width; ++k, ++column) {
      const double kept = parameters[column];
      std::vector<double> derivative(num_residuals, 0.0);
      for (const auto& [steps, weight] :
           {std::pair{-2.0, 1.0}, {-1.0, -8.0}, {1.0, 8.0}, {2.0, -1.0}}) {
        parameters[column] = kept + steps * kStep;
        cost.Evaluate(blocks.data(), residuals.data(), nullptr);
        for (std::size_t r = 0; r < num_residuals; ++r) {
          derivative[r] += weight * residuals[r] / (12.0 * kStep);
        }
      }
      parameters[column] = kept;
      for (std::size_t r = 0; r < num_residuals; ++r) {
        const double found = analytic[b][r * width + k];
        // Negated, so that a NaN fails.
        if (!(std::abs(found - derivative[r]) <=
              tolerance * std::max(scale, std::abs(derivative[r])))) {
          return ::testing::AssertionFailure()
                 << "residual " << r << " by parameter block " << b << " (entry " << k
                 << "): " << found << ", numerically " << derivative[r];
        }
      }
    }
  }
  return ::testing::AssertionSuccess();
}

}  // namespace howl

#define EXPECT_CORRECT_JACOBIAN(cost, parameters) \
  EXPECT_TRUE(::howl::JacobianIsCorrect(cost, parameters))

#endif  // HOWL_TESTS_RESIDUAL_JACOBIAN_H_
