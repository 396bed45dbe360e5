#include "estimation/record_fit/fit_under_prior.h"

#include <cmath>
#include <utility>
#include <vector>

#include "estimation/record_fit/other_starts.h"
#include "estimation/record_fit/starts/path_starts.h"

namespace howl {

Eigen::VectorXd WithBestFlame(const RecordSpectra& record, const PointStructure& structure,
                              const Eigen::VectorXd& parameters) {
  LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  point.flame = PathStarts(record).Flame(point.path);
  return ToParameters(structure, point);
}

PointFit FitAgain(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& before, const PointPrior& prior, const PointFit& fit) {
  const Eigen::MatrixXd of_record = fit.InformationOfRecord(before);
  PointFitOptions options;
  options.of_record = &of_record;
  PointFit out = FitPoint(record, structure, prior, prior.Within(fit.parameters), options);
  if (std::isfinite(out.log_posterior)) return out;
  return FitUnder(record, structure, prior, fit.parameters, false);
}

PointFit FitUnder(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, const Eigen::VectorXd& at, bool from_prior) {
  PointFit best = FitPoint(record, structure, prior, prior.Within(at));
  if (!from_prior && std::isfinite(best.log_posterior)) return best;
  // The two cuts depend on one another little: the acoustics that others tell with its own path,
  // and the reverse.
  const auto path_of = [&](Eigen::VectorXd parameters, const Eigen::VectorXd& path) {
    const Eigen::Index first = structure.Delay();
    parameters.segment(first, structure.Delays()) = path.segment(first, structure.Delays());
    return WithBestFlame(record, structure, parameters);
  };
  const std::vector<Eigen::VectorXd> starts = {path_of(prior.mean, prior.mean),
                                               path_of(prior.mean, best.parameters),
                                               path_of(best.parameters, prior.mean)};
  return BestWith(record, structure, prior, std::move(best), starts);
}

}  // namespace howl
