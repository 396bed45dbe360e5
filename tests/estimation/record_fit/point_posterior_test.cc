#include "estimation/record_fit/point_posterior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/estimation/record_fit/identified.h"

namespace howl::point_posterior_test {
namespace {

// Against differences of the value, along each parameter and along each two of them.
TEST(PointPosterior, CurvatureIsThatOfTheValue) {
  const ModalLoop loop = DuctOfModes(2);
  const RecordSpectra record =
      MakeRecordSpectra(SimulateModalLoop(loop, 0.5, 1), 203.0, FlameInput::kPressureRate);
  PointStructure structure = FreeStructure(2);
  structure.noise.push_back({LoopNoise::kDuct, 2});
  const PointPrior prior = PriorOf(structure, record);
  const Eigen::VectorXd at =
      FitPoint(record, structure, prior, StartsOf(record, structure, prior, 4, 1).front(),
               kToTheMaximum)
          .parameters;
  PointPosterior posterior(record, structure, prior);
  const PosteriorSlopes here = posterior.Expand(at);
  const Eigen::MatrixXd curvature = posterior.Curvature(at, here);
  const Eigen::Index size = at.size();
  // In units of what each is known by, the curvature's diagonal is about one.
  const Eigen::VectorXd known_by =
      here.information.diagonal().cwiseMax(1.0).cwiseSqrt().cwiseInverse();
  constexpr double kStep = 0.01;
  const auto second_difference = [&](const Eigen::VectorXd& along) {
    const Eigen::VectorXd by = kStep * along.cwiseProduct(prior.deviation);
    return (posterior.Value(at + by) - 2.0 * posterior.Value(at) + posterior.Value(at - by)) /
           (kStep * kStep);
  };
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      Eigen::VectorXd along = Eigen::VectorXd::Zero(size);
      along[i] += known_by[i];
      along[j] += known_by[j];
      const double foretold = -along.dot(curvature * along);
      EXPECT_NEAR(second_difference(along), foretold, 0.01 * (1.0 + std::abs(foretold)))
          << "parameters " << i << " and " << j << " of " << size;
    }
  }
  EXPECT_EQ(curvature, curvature.transpose());
}

}  // namespace
}  // namespace howl::point_posterior_test
