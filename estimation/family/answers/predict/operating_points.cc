#include <algorithm>
#include <cmath>
#include <numeric>

#include "estimation/family/answers/predict/operating_path.h"

namespace howl {
namespace {

constexpr double kSamePoint = 1e-9;  // of phi, or of the measured range where that is wider

}  // namespace

OperatingPoints::OperatingPoints(std::span<const Experiment> experiments) {
  std::vector<std::size_t> order(experiments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return experiments[i].phi; });
  for (const std::size_t i : order) {
    const Experiment& experiment = experiments[i];
    if (phi_.empty() || phi_.back() != experiment.phi) {
      phi_.push_back(experiment.phi);
      reliable_.push_back(true);
      experiments_.emplace_back();
    }
    reliable_.back() = reliable_.back() && experiment.reliable;
    experiments_.back().push_back(i);
  }
}

std::optional<std::size_t> OperatingPoints::Measured(double phi) const {
  for (std::size_t k = 0; k < size(); ++k) {
    if (std::abs(phi - phi_[k]) <= kSamePoint * std::max(std::abs(phi_[k]), width())) return k;
  }
  return std::nullopt;
}

PointKind OperatingPoints::KindOf(double phi) const {
  if (Measured(phi)) return PointKind::kMeasured;
  if (phi > phi_.front() && phi < phi_.back()) return PointKind::kBetween;
  const double beyond = std::max(phi_.front() - phi, phi - phi_.back());
  return beyond <= width() * (1.0 + kSamePoint) ? PointKind::kBeyond : PointKind::kOutside;
}

std::pair<std::size_t, std::size_t> OperatingPoints::Neighbours(double phi) const {
  if (const auto k = Measured(phi)) return {*k, *k};
  const auto above = static_cast<std::size_t>(
      std::distance(phi_.begin(), std::upper_bound(phi_.begin(), phi_.end(), phi)));
  if (above == 0) return {0, 0};
  if (above == size()) return {size() - 1, size() - 1};
  return {above - 1, above};
}

bool OperatingPoints::RestsOnUnreliable(double phi) const {
  const auto [below, above] = Neighbours(phi);
  return !reliable_[below] || !reliable_[above];
}

}  // namespace howl
