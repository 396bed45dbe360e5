#include "estimation/record_fit/mode_maxima.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "estimation/record_fit/other_starts.h"
#include "estimation/record_fit/starts/pole_starts.h"

namespace howl {
namespace {

constexpr int kMostModeScans = 4;

// Parameters with one of the modes that are tied to no other elsewhere.
std::vector<Eigen::VectorXd> Elsewhere(const RecordSpectra& record, const PointStructure& structure,
                                       const PointPrior& prior, const PoleStarts& starts,
                                       const Eigen::VectorXd& parameters) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  std::vector<StartPole> here;
  for (const LoopMode& mode : point.modes) here.push_back({mode.omega, mode.xi});
  std::vector<Eigen::VectorXd> out;
  const auto tied = static_cast<std::size_t>(structure.ratio ? structure.FirstModes() : 0);
  for (std::size_t k = tied; k < here.size(); ++k) {
    std::vector<StartPole> others = here;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    std::vector<StartPole> place = here;
    place[k] = starts.Next(others);
    LoopPoint moved = point;
    moved.modes = starts.WithResidues(place);
    out.push_back(prior.Within(ToParameters(structure, moved)));
  }
  return out;
}

}  // namespace

PointFit BestByModes(const RecordSpectra& record, const PointStructure& structure,
                     const PointPrior& prior, PointFit fit) {
  if (structure.ratio && structure.further_modes == 0) return fit;
  const PoleStarts starts(record, structure);
  for (int scan = 0; scan < kMostModeScans; ++scan) {
    const double before = fit.log_posterior;
    const std::vector<Eigen::VectorXd> elsewhere =
        Elsewhere(record, structure, prior, starts, fit.parameters);
    fit = BestWith(record, structure, prior, std::move(fit), elsewhere, kToTheMaximum);
    if (fit.log_posterior - before < kWorthAnother) break;
  }
  return fit;
}

}  // namespace howl
