#include "estimation/joint_records/choose_modes.h"

#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace howl {
namespace {

constexpr std::size_t kMostWithoutGain = 2;

}  // namespace

double ModesTried::Sum() const {
  return std::accumulate(log_density.begin(), log_density.end(), 0.0);
}

ChosenLoop FitLoop(const std::vector<OperatingPoint>& points, const RecordLoopSpec& spec,
                   const RecordsFitOptions& options) {
  ChosenLoop out;
  std::optional<RecordsFit> before;
  const int first = spec.choose_modes ? 1 : spec.modes;
  const int last = spec.choose_modes ? kMostModes : spec.modes;
  for (int modes = first; modes <= last; ++modes) {
    // Tied modes of one number are no special case of those of another.
    const RecordsFit* const poorer = before && !spec.ratio ? &*before : nullptr;
    RecordsFitOptions of_these = options;
    of_these.key += "modes/" + std::to_string(modes) + "/";
    RecordsFit fit = FitRecords(points, StructureOf(spec, modes), of_these, poorer);
    out.tried.push_back({modes, LeftOutDensities(points, fit, of_these)});
    const std::size_t now = out.tried.size() - 1;
    if (now == 0 || out.tried[now].Sum() > out.tried[out.chosen].Sum()) {
      out.chosen = now;
      out.fit = fit;
    }
    before = std::move(fit);
    if (now - out.chosen >= kMostWithoutGain) break;
  }
  return out;
}

}  // namespace howl
