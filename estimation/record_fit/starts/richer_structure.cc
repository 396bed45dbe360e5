#include "estimation/record_fit/starts/richer_structure.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/starts/hum_start.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "estimation/record_fit/starts/pole_starts.h"

namespace howl {
namespace {

constexpr double kLittleSpread = 0.1;  // rho
constexpr double kHardlyShows = 4.0;   // nats below the least of the others

const NoiseTerm* TermOf(const PointStructure& structure, LoopNoise source) {
  const auto at = std::ranges::find(structure.noise, source, &NoiseTerm::source);
  return at == structure.noise.end() ? nullptr : &*at;
}

}  // namespace

bool Contains(const PointStructure& rich, const PointStructure& poor) {
  if (rich.modes < poor.modes || (rich.ratio && rich.ratio != poor.ratio)) return false;
  if (rich.ratio && rich.FirstModes() != poor.FirstModes()) return false;
  if (!rich.own_damping && rich.further_modes < poor.further_modes) return false;
  if (poor.own_damping && !rich.own_damping) return false;
  if (poor.complex_residues && !rich.complex_residues) return false;
  if (poor.HasSpread() && rich.delay_spread != poor.delay_spread) return false;
  if (poor.second_path && !rich.second_path) return false;
  if (rich.acoustic_lines < poor.acoustic_lines || rich.flame_lines < poor.flame_lines)
    return false;
  const auto lacks = [&](const SlowChangeOfStructure& each) {
    return poor.*each.has && !(rich.*each.has);
  };
  if (std::ranges::any_of(kAcousticChanges, lacks) || std::ranges::any_of(kFlameChanges, lacks)) {
    return false;
  }
  return std::ranges::all_of(poor.noise, [&](const NoiseTerm& term) {
    const NoiseTerm* of_rich = TermOf(rich, term.source);
    return of_rich != nullptr && of_rich->coefficients >= term.coefficients;
  });
}

std::vector<LoopMode> FurtherModes(const RecordSpectra& record, const PointStructure& poor,
                                   const Eigen::VectorXd& parameters, const PointStructure& rich) {
  if (rich.modes == poor.modes) return {};
  const PoleStarts starts(record, rich);
  std::vector<StartPole> poles;
  for (const LoopMode& mode : ToPoint(poor, record.flame.cols(), parameters).modes) {
    poles.push_back({mode.omega, mode.xi});
  }
  while (static_cast<int>(poles.size()) < rich.modes) poles.push_back(starts.Next(poles));
  std::vector<LoopMode> modes = starts.WithResidues(poles);
  modes.erase(modes.begin(), modes.begin() + poor.modes);
  return modes;
}

Eigen::VectorXd InRicherStructure(const RecordSpectra& record, const PointStructure& poor,
                                  const Eigen::VectorXd& parameters, const PointStructure& rich,
                                  const std::vector<LoopMode>& further) {
  CHECK(Contains(rich, poor));
  CHECK_EQ(static_cast<int>(further.size()), rich.modes - poor.modes);
  LoopPoint point = ToPoint(poor, record.flame.cols(), parameters);
  if (rich.delay_spread != poor.delay_spread) {
    point.path.spread = rich.delay_spread;
    point.path.rho = kLittleSpread;
  }
  if (rich.second_path && !poor.second_path) {
    point.path.second = SecondPath{0.0, 1.0};
  }
  point.modes.insert(point.modes.end(), further.begin(), further.end());
  double least = 0.0;
  for (const Eigen::VectorXd& source : point.noise) least = std::min(least, source[0]);
  const LoopResiduals left =
      ResidualsOf(record, poor, ToPoint(poor, record.flame.cols(), parameters));
  std::vector<Eigen::VectorXd> noise;
  for (const NoiseTerm& term : rich.noise) {
    Eigen::VectorXd c = Eigen::VectorXd::Zero(term.coefficients);
    c[0] = least - kHardlyShows;
    if (term.source == LoopNoise::kBackground && !HasBackground(poor.noise)) {
      // At a level that hardly shows nothing would tell the ratio.
      const BackgroundStart start = BackgroundOf(record);
      point.background_ratio = start.ratio;
      c[0] = start.log_level;
    }
    if (HasLines(term.source)) c = HumStart(record, term, left);
    for (std::size_t j = 0; j < poor.noise.size(); ++j) {
      if (poor.noise[j].source != term.source) continue;
      // A single line tells nothing of others.
      if (HasOneLine(poor.noise[j]) && !HasOneLine(term)) continue;
      c[0] = 0.0;
      c.head(point.noise[j].size()) = point.noise[j];
    }
    noise.push_back(c);
  }
  point.noise = std::move(noise);
  return ToParameters(rich, point);
}

}  // namespace howl
