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
  if (from_prior || !std::isfinite(best.log_posterior)) {
    PointFit other =
        FitPoint(record, structure, prior, WithBestFlame(record, structure, prior.mean));
    if (other.log_posterior > best.log_posterior) best = std::move(other);
  }
  return best;
}

}  // namespace howl
