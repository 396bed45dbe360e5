// A point's fit from several starts (point_fit.h).
#include <glog/logging.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "estimation/record_fit/point_fit.h"
#include "estimation/record_fit/spectra/middle_part.h"

namespace howl {
namespace {

constexpr std::size_t kMostToCompare = 4;
constexpr int kIterationsToCompare = 30;
constexpr double kSameDelay = 0.03;  // of a path's parameters
constexpr std::size_t kMostDelays = 3;

// The best acoustics with each other delay and flame that a fit has come to: the two cuts depend on
// one another little, so that the best of each may have begun apart.
std::vector<Eigen::VectorXd> OtherDelays(const PointStructure& structure,
                                         const Eigen::VectorXd& best,
                                         const std::vector<PointFit>& fits) {
  const auto path_of = [&](const Eigen::VectorXd& parameters) {
    return parameters.segment(structure.Delay(), structure.Delays()).eval();
  };
  std::vector<Eigen::VectorXd> known = {path_of(best)};
  std::vector<Eigen::VectorXd> out;
  for (const PointFit& fit : fits) {
    const Eigen::VectorXd path = path_of(fit.parameters);
    const auto same = [&](const Eigen::VectorXd& other) {
      return (other - path).cwiseAbs().maxCoeff() < kSameDelay;
    };
    if (std::ranges::any_of(known, same)) continue;
    if (out.size() == kMostDelays) break;
    known.push_back(path);
    Eigen::VectorXd crossed = best;
    const Eigen::Index flame = best.size() - structure.Delay() - structure.NoiseParameters();
    crossed.segment(structure.Delay(), flame) = fit.parameters.segment(structure.Delay(), flame);
    out.push_back(std::move(crossed));
  }
  return out;
}

}  // namespace

PointFit FitPoint(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, const std::vector<Eigen::VectorXd>& starts,
                  const PointFitOptions& options) {
  CHECK(!starts.empty());
  const auto fit_all = [&](const RecordSpectra& of, const std::vector<Eigen::VectorXd>& from,
                           const PointFitOptions& stage) {
    std::vector<PointFit> fits;
    for (const Eigen::VectorXd& start : from) {
      fits.push_back(FitPoint(of, structure, prior, start, stage));
    }
    std::ranges::stable_sort(fits, std::ranges::greater(), &PointFit::log_posterior);
    return fits;
  };
  // Near a maximum, then past the valleys that lead there, and at last on it.
  PointFitOptions near = options;
  near.converged = kNearMaximum;
  const std::optional<RecordSpectra> part = MiddlePart(record);
  const std::vector<PointFit> all = fit_all(part ? *part : record, starts, near);
  std::vector<Eigen::VectorXd> best;
  for (std::size_t i = 0; i < std::min(all.size(), kMostToCompare); ++i) {
    best.push_back(all[i].parameters);
    if (part) best[i] = WithoutTransients(structure, std::move(best[i]));
  }
  PointFitOptions stage = options;
  stage.iterations = std::min(options.iterations, kIterationsToCompare);
  std::vector<PointFit> fits = fit_all(record, best, stage);
  std::vector<Eigen::VectorXd> crossed = OtherDelays(structure, fits[0].parameters, all);
  if (!crossed.empty()) {
    crossed.push_back(fits[0].parameters);
    fits = fit_all(record, crossed, stage);
  }
  if (fits[0].converged) return fits[0];
  return FitPoint(record, structure, prior, fits[0].parameters, options);
}

}  // namespace howl
