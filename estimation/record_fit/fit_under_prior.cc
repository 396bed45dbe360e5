#include "estimation/record_fit/fit_under_prior.h"

#include <cmath>
#include <utility>

#include "estimation/record_fit/starts/path_starts.h"

namespace howl {

Eigen::VectorXd WithBestFlame(const RecordSpectra& record, const PointStructure& structure,
                              const Eigen::VectorXd& parameters) {
  LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  point.flame = PathStarts(record).Flame(point.path);
  return ToParameters(structure, point);
}

PointFit FitUnder(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, const Eigen::VectorXd& at, bool from_prior) {
  PointFit best = FitPoint(record, structure, prior, prior.Within(at));
  const auto consider = [&](const Eigen::VectorXd& start) {
    PointFit other = FitPoint(record, structure, prior, WithBestFlame(record, structure, start));
    if (other.log_posterior > best.log_posterior) best = std::move(other);
  };
  if (from_prior || !std::isfinite(best.log_posterior)) {
    consider(prior.mean);
    // The two cuts depend on one another little: its own acoustics, with the path that others tell.
    Eigen::VectorXd path = best.parameters;
    path.segment(structure.Delay(), structure.Delays()) =
        prior.mean.segment(structure.Delay(), structure.Delays());
    consider(path);
  }
  return best;
}

}  // namespace howl
