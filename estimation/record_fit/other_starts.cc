#include "estimation/record_fit/other_starts.h"

#include <optional>
#include <utility>

#include "estimation/record_fit/spectra/middle_part.h"

namespace howl {

PointFit BestWith(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, PointFit fit, const std::vector<Eigen::VectorXd>& starts,
                  const PointFitOptions& options) {
  const std::optional<RecordSpectra> part = MiddlePart(record);
  const auto on_part = [&](const Eigen::VectorXd& start) {
    return FitPoint(*part, structure, prior, WithoutTransients(structure, start), kToTheMaximum);
  };
  const double known = part ? on_part(fit.parameters).log_posterior : 0.0;
  for (Eigen::VectorXd start : starts) {
    if (part) {
      const PointFit there = on_part(start);
      if (!(there.log_posterior > known)) continue;
      start = WithoutTransients(structure, there.parameters);
    }
    PointFit other = FitPoint(record, structure, prior, std::move(start), options);
    if (other.log_posterior > fit.log_posterior) fit = std::move(other);
  }
  return fit;
}

}  // namespace howl
