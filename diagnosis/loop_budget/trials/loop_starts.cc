#include "diagnosis/loop_budget/trials/loop_starts.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "estimation/parallel.h"
#include "estimation/record_fit/starts/path_starts.h"
#include "estimation/record_fit/starts/pole_starts.h"

namespace howl {
namespace {

constexpr std::size_t kDelaysTried = 3;
// With the right input a flame's delays need not be spread to make up for a wrong one.
constexpr double kLittleSpread = 0.1;

// The noise of `from` in the sources of `to`, which has no source that `from` has not.
std::vector<Eigen::VectorXd> NoiseIn(const PointStructure& from,
                                     const std::vector<Eigen::VectorXd>& noise,
                                     const PointStructure& to) {
  std::vector<Eigen::VectorXd> out;
  for (const NoiseTerm& term : to.noise) {
    const auto at = std::ranges::find(from.noise, term.source, &NoiseTerm::source);
    const auto j = static_cast<std::size_t>(at - from.noise.begin());
    out.emplace_back(noise[j].head(term.coefficients));
  }
  return out;
}

// One row for each of the delays with which the flame, driven by another signal, leaves least of q.
LoopStarts WithOtherInput(const LoopRecords& records, const LoopForm& form,
                          std::vector<LoopPoint> points) {
  const PointStructure& structure = form.structure;
  LoopStarts out;
  out.apart = true;
  out.rows.resize(kDelaysTried);
  for (std::size_t e = 0; e < records.size(); ++e) {
    const RecordSpectra record = records.Whole(form, e);
    const PathStarts paths(record);
    const std::vector<double> delays = paths.Delays(kDelaysTried);
    for (std::size_t i = 0; i < kDelaysTried; ++i) {
      LoopPoint& point = points[e];
      point.path.tau = delays[std::min(i, delays.size() - 1)];
      if (structure.HasSpread()) point.path.rho = kLittleSpread;
      point.flame = paths.Flame(point.path);
      out.rows[i].push_back(ToParameters(structure, point));
    }
  }
  return out;
}

}  // namespace

double LoopFit::Density() const {
  return std::accumulate(log_density.begin(), log_density.end(), 0.0);
}

std::vector<Eigen::VectorXd> ParametersOf(const std::vector<PointFit>& fits) {
  std::vector<Eigen::VectorXd> out;
  for (const PointFit& fit : fits) out.push_back(fit.parameters);
  return out;
}

std::vector<Eigen::VectorXd> ParametersOf(const LoopFit& fit) {
  return ParametersOf(fit.fit.points);
}

std::vector<LoopPoint> PointsOf(const LoopRecords& records, const LoopFit& fit) {
  std::vector<LoopPoint> out;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const Eigen::Index flame = records.FlameTerms(fit.model.flame_input, e);
    out.push_back(ToPoint(fit.model.structure, flame, fit.fit.points[e].parameters));
  }
  return out;
}

StartRows Again(const LoopRecords& records, const LoopFit& fit, int threads) {
  StartRows out = {ParametersOf(fit)};
  const PointStructure& structure = fit.model.structure;
  if (!structure.ratio || structure.FirstModes() < 2) return out;
  out.push_back(out[0]);
  RunUnits(records.size(), threads, [&](std::size_t e) {
    const RecordSpectra record = records.Whole(fit.model, e);
    const PoleStarts poles(record, structure);
    LoopPoint point = ToPoint(structure, record.flame.cols(), out[0][e]);
    point.modes = poles.WithResidues(poles.Greedy());
    out[1][e] = ToParameters(structure, point);
  });
  return out;
}

LoopStarts StartsWith(const LoopRecords& records, const LoopFit& from, const LoopForm& with,
                      int threads) {
  if (with.flame_input != from.model.flame_input) {
    return WithOtherInput(records, with, PointsOf(records, from));
  }
  return {StartsInRicher(records.Points(with), from.fit, with.structure, threads),
          with.structure.second_path && !from.model.structure.second_path};
}

LoopStarts StartsWithout(const LoopRecords& records, const LoopFit& from, const LoopForm& without,
                         std::size_t mode) {
  std::vector<LoopPoint> points = PointsOf(records, from);
  const auto kept = static_cast<std::size_t>(without.structure.modes);
  for (LoopPoint& point : points) {
    if (point.modes.size() > kept) {
      const auto first = point.modes.begin() + static_cast<std::ptrdiff_t>(mode);
      point.modes.erase(first, first + static_cast<std::ptrdiff_t>(point.modes.size() - kept));
    }
    point.noise = NoiseIn(from.model.structure, point.noise, without.structure);
    if (without.structure.delay_spread == DelaySpread::kNone) {
      point.path.spread = DelaySpread::kNone;
      point.path.rho = 0.0;
    }
    if (!without.structure.second_path) point.path.second.reset();
    point.acoustic_lines.conservativeResize(without.structure.acoustic_lines);
    point.flame_lines.conservativeResize(without.structure.flame_lines);
  }
  if (without.flame_input != from.model.flame_input) {
    return WithOtherInput(records, without, std::move(points));
  }
  LoopStarts out;
  for (const LoopPoint& point : points) {
    if (out.rows.empty()) out.rows.emplace_back();
    out.rows[0].push_back(ToParameters(without.structure, point));
  }
  return out;
}

}  // namespace howl
