#include "estimation/record_fit/second_path_starts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "estimation/record_fit/point_posterior.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

// Of a second path: later by a twelfth of a period to two of them.
constexpr std::size_t kLambdas = 24;
constexpr double kLeastLambda = std::numbers::pi / 6.0;
constexpr double kMostLambda = 4.0 * std::numbers::pi;

}  // namespace

std::vector<Eigen::VectorXd> WithTwoPaths(const RecordSpectra& record,
                                          const PointStructure& structure, const PointPrior& prior,
                                          Eigen::VectorXd parameters, std::size_t count) {
  const Eigen::Index share = structure.SecondPath();
  PointPosterior posterior(record, structure, prior);
  std::vector<double> gain(kLambdas, 0.0);
  std::vector<Eigen::VectorXd> out(kLambdas, parameters);
  for (std::size_t i = 0; i < kLambdas; ++i) {
    const double way = static_cast<double>(i) / (kLambdas - 1);
    parameters[share] = 0.0;
    parameters[share + 1] = std::log(kLeastLambda + way * (kMostLambda - kLeastLambda));
    const PosteriorSlopes slopes = posterior.Expand(parameters);
    Eigen::VectorXd step = SolveSymmetric(Positive(slopes.information), slopes.gradient);
    const double foretold = 0.5 * slopes.gradient.dot(step);
    if (!std::isfinite(foretold)) continue;
    gain[i] = foretold;
    step[share + 1] = 0.0;
    step *= posterior.ShareWithin(parameters, step);
    out[i] = parameters + step.cwiseProduct(prior.deviation);
  }
  std::vector<std::size_t> best(kLambdas);
  std::iota(best.begin(), best.end(), 0);
  std::erase_if(best, [&](std::size_t i) {
    return (i > 0 && gain[i - 1] > gain[i]) || (i + 1 < kLambdas && gain[i + 1] > gain[i]);
  });
  std::ranges::stable_sort(best, std::ranges::greater(), [&](std::size_t i) { return gain[i]; });
  best.resize(std::min(count, best.size()));
  std::vector<Eigen::VectorXd> starts;
  for (const std::size_t i : best) starts.push_back(out[i]);
  return starts;
}

}  // namespace howl
