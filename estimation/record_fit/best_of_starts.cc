// A point's fit from several starts (point_fit.h).
#include <glog/logging.h>

#include <algorithm>
#include <vector>

#include "estimation/record_fit/point_fit.h"
#include "estimation/record_fit/spectra/middle_part.h"

namespace howl {
namespace {

constexpr std::size_t kMostToCompare = 4;
constexpr int kIterationsToCompare = 30;
constexpr double kSameDelay = 0.03;  // of a path's parameters
constexpr std::size_t kMostDelays = 3;
constexpr double kSameMaximum = 0.01;  // nats

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

// The best of fits that are in order, and the next best that is another maximum.
std::vector<PointFit> Different(const std::vector<PointFit>& fits) {
  std::vector<PointFit> out = {fits[0]};
  for (const PointFit& fit : fits) {
    if (fit.log_posterior > fits[0].log_posterior - kSameMaximum) continue;
    out.push_back(fit);
    break;
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
  const RecordSpectra& compared = MiddleOf(record);
  // Near a maximum, then past the valleys that lead there, and at last on it.
  PointFitOptions near = options;
  near.converged = kNearMaximum;
  near.curvature = false;
  const std::vector<PointFit> all = fit_all(compared, starts, near);
  std::vector<Eigen::VectorXd> best;
  for (std::size_t i = 0; i < std::min(all.size(), kMostToCompare); ++i) {
    best.push_back(all[i].parameters);
  }
  PointFitOptions stage = options;
  stage.iterations = std::min(options.iterations, kIterationsToCompare);
  stage.curvature = false;
  std::vector<PointFit> fits = fit_all(compared, best, stage);
  const std::vector<Eigen::VectorXd> crossed = OtherDelays(structure, fits[0].parameters, all);
  for (PointFit& fit : fit_all(compared, crossed, stage)) fits.push_back(std::move(fit));
  std::ranges::stable_sort(fits, std::ranges::greater(), &PointFit::log_posterior);
  std::vector<Eigen::VectorXd> of_whole;
  for (const PointFit& fit : Different(fits)) {
    of_whole.push_back(BesideMiddle(record, structure, fit.parameters));
  }
  return fit_all(record, of_whole, options)[0];
}

}  // namespace howl
