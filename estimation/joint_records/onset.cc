#include "estimation/joint_records/onset.h"

#include <cmath>
#include <optional>
#include <vector>

#include "estimation/analysis/loop/straight_line.h"

namespace howl {

Onset OnsetOf(std::span<const OnsetPoint> points) {
  std::vector<LoopGainPoint> gains;
  std::vector<LinePoint> frequencies;
  for (const OnsetPoint& point : points) {
    if (!point.loop.found) continue;
    gains.push_back({point.operating_parameter, point.loop.loop_gain});
    frequencies.push_back({point.operating_parameter, point.loop.frequency_hz});
  }
  Onset onset;
  onset.at = EstimateVanishingPhi(gains);
  const std::optional<StraightLine> line = FitStraightLine(frequencies);
  if (!line || !std::isfinite(onset.at.lo) || !std::isfinite(onset.at.hi)) return onset;
  // Half of the interval of the line there, and by how much it rises over half of the onset's.
  const double of_line = line->t * std::sqrt(line->Variance(onset.at.phi));
  const double of_place = line->slope * 0.5 * (onset.at.hi - onset.at.lo);
  onset.frequency_hz = {line->At(onset.at.phi), std::hypot(of_line, of_place) / kNormal95};
  return onset;
}

}  // namespace howl
