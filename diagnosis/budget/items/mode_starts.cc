#include "diagnosis/budget/items/mode_starts.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/structure/point_scoring.h"
#include "model/numerics/parallel_for.h"

namespace howl {
namespace {

constexpr int kFrequencies = 28;  // steps of a tenth, from a third of the cycle's frequency on
constexpr double kLowest = 0.35;
constexpr double kStep = 1.1;
constexpr std::array kDampings = {0.03, 0.1};
constexpr std::size_t kStarts = 2;
constexpr double kLargestResidue = 1.0;

struct Place {
  double ratio;  // of the cycle's frequency
  double xi;
  double gain = 0.0;
  std::vector<Eigen::Vector2d> residues = {};
};

std::vector<Place> Grid(std::size_t points) {
  std::vector<Place> out;
  for (int i = 0; i < kFrequencies; ++i) {
    for (const double xi : kDampings) {
      out.push_back({kLowest * std::pow(kStep, i), xi, 0.0,
                     std::vector<Eigen::Vector2d>(points, Eigen::Vector2d::Zero())});
    }
  }
  return out;
}

// The gain at one operating point, with the residue that gives it.
double GainAt(const PointLayout& layout, const PointScore& score, Eigen::Vector2d* residue) {
  const Eigen::Index own = layout.Own();
  const Eigen::Index a = layout.Acoustics() - 2;
  Eigen::MatrixXd h = score.information.topLeftCorner(own, own);
  Eigen::VectorXd g = score.gradient.head(own);
  // At no residue neither the frequency nor the damping has any effect: their rows are the prior's.
  const Eigen::VectorXd full = h.ldlt().solve(g);
  std::vector<Eigen::Index> rest;
  for (Eigen::Index k = 0; k < own; ++k) {
    if (k < a || k >= a + 2) rest.push_back(k);
  }
  const Eigen::VectorXd g_rest = g(rest);
  const double with = g.dot(full);
  const double without = g_rest.dot(h(rest, rest).ldlt().solve(g_rest));
  *residue = full.segment<2>(a).cwiseMax(-kLargestResidue).cwiseMin(kLargestResidue);
  return 0.5 * std::max(with - without, 0.0);
}

}  // namespace

std::vector<StructureFit> ModeStarts(const std::vector<JointBand>& bands,
                                     const StructureFit& from) {
  StructureFit with = from;
  ++with.structure.further_modes;
  PointLayout layout = LayoutOf(with.structure, bands[0].record.model);
  layout.shared_fixed = true;
  const EffectPointer joined = with.structure.Joined();
  std::vector<Place> grid = Grid(bands.size());
  std::vector<std::vector<double>> gains(bands.size(), std::vector<double>(grid.size(), 0.0));
  ParallelFor(bands.size(), [&](std::size_t e) {
    const JointBand& band = bands[e];
    const JointResiduals now = MakeJointResiduals(band, *joined, from.shared, from.points[e]);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      PointLoop point = from.points[e];
      const double hz = grid[i].ratio * band.record.at.cycle_frequency_hz;
      if (hz > band.frequency_hz[band.count - 1]) continue;
      point.modes.emplace_back(std::log(hz), std::log(grid[i].xi), 0.0, 0.0);
      const PointScore score = ScorePoint(layout, band, *joined, with.structure.noise, from.shared,
                                          point, from.centres[e], now);
      gains[e][i] = GainAt(layout, score, &grid[i].residues[e]);
    }
  });
  for (std::size_t i = 0; i < grid.size(); ++i) {
    for (const std::vector<double>& of_point : gains) grid[i].gain += of_point[i];
  }
  std::ranges::stable_sort(grid, std::ranges::greater(), &Place::gain);
  std::vector<Place> best;
  for (const Place& place : grid) {
    if (best.size() == kStarts) break;
    const bool apart = std::ranges::none_of(best, [&](const Place& other) {
      return std::abs(std::log(place.ratio / other.ratio)) < 2.5 * std::log(kStep);
    });
    if (apart) best.push_back(place);
  }
  std::vector<StructureFit> out;
  for (const Place& place : best) {
    out.push_back(with);
    for (std::size_t e = 0; e < bands.size(); ++e) {
      const double hz = place.ratio * bands[e].record.at.cycle_frequency_hz;
      const Eigen::Vector4d mode(std::log(hz), std::log(place.xi), place.residues[e][0],
                                 place.residues[e][1]);
      out.back().points[e].modes.push_back(mode);
      out.back().centres[e].modes.push_back(mode);
    }
  }
  return out;
}

}  // namespace howl
