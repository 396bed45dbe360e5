#include "estimation/record_fit/other_starts.h"

#include <cmath>
#include <limits>
#include <utility>

#include "estimation/record_fit/spectra/middle_part.h"

namespace howl {

PointFit BestWith(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, PointFit fit, const std::vector<Eigen::VectorXd>& starts,
                  const PointFitOptions& options) {
  const auto begin = [&](const Eigen::VectorXd& start) {
    return BesideMiddle(record, structure, start);
  };
  const auto on_middle = [&](const Eigen::VectorXd& start) {
    return FitPoint(MiddleOf(record), structure, prior, begin(start), kToCompare);
  };
  PointFit best;
  best.log_posterior = -std::numeric_limits<double>::infinity();
  for (const Eigen::VectorXd& start : starts) {
    PointFit there = on_middle(start);
    if (there.log_posterior > best.log_posterior) best = std::move(there);
  }
  if (!std::isfinite(best.log_posterior)) return fit;
  if (!(best.log_posterior > on_middle(fit.parameters).log_posterior)) return fit;
  PointFit other = FitPoint(record, structure, prior, begin(best.parameters), options);
  return other.log_posterior > fit.log_posterior ? other : fit;
}

}  // namespace howl
