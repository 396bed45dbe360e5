#include "estimation/joint_records/choose_loop.h"

#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "estimation/joint_records/loop_names.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr std::size_t kMostWithoutGain = 2;

std::vector<OperatingPoint> PointsOf(const std::vector<LoopRecord>& records, FlameInput input,
                                     int threads) {
  std::vector<OperatingPoint> points(records.size());
  RunUnits(records.size(), threads, [&](std::size_t e) {
    points[e] = {records[e].operating_parameter,
                 MakeRecordSpectra(records[e].record, records[e].cycle_hz, input)};
  });
  return points;
}

// With the best loop of this input in the place of `out`'s, where it is better.
void TryInput(FlameInput input, const std::vector<LoopRecord>& records, const RecordLoopSpec& spec,
              const RecordsFitOptions& options, ChosenLoop* out) {
  std::vector<OperatingPoint> points = PointsOf(records, input, options.threads);
  std::optional<RecordsFit> before;
  std::size_t without_gain = 0;
  double most = 0.0;
  const int first = spec.choose_modes ? 1 : spec.modes;
  const int last = spec.choose_modes ? kMostModes : spec.modes;
  for (int modes = first; modes <= last && without_gain < kMostWithoutGain; ++modes) {
    // Tied modes of one number are no special case of those of another.
    const RecordsFit* const poorer = before && !spec.ratio ? &*before : nullptr;
    RecordsFitOptions of_these = options;
    of_these.key += "modes/" + std::to_string(modes) + "/";
    RecordsFit fit = FitRecords(points, StructureOf(spec, modes), of_these, poorer);
    fit = FitDriven(fit, of_these, &points);
    FitWithHalves found = GoOnFromHalves(records, points, std::move(fit), of_these);
    out->tried.push_back({input, modes, std::move(found.log_density)});
    const double now = out->tried.back().Sum();
    without_gain = modes == first || now > most ? 0 : without_gain + 1;
    if (without_gain == 0) most = now;
    if (out->tried.size() == 1 || now > out->tried[out->chosen].Sum()) {
      out->chosen = out->tried.size() - 1;
      out->fit = found.fit;
      out->halves = std::move(found.halves);
      out->points = points;
    }
    before = std::move(found.fit);
  }
}

}  // namespace

double LoopTried::Sum() const {
  return std::accumulate(log_density.begin(), log_density.end(), 0.0);
}

ChosenLoop FitLoop(const std::vector<LoopRecord>& records, const RecordLoopSpec& spec,
                   const RecordsFitOptions& options) {
  ChosenLoop out;
  if (!spec.choose_flame_input) {
    TryInput(spec.flame_input, records, spec, options, &out);
    return out;
  }
  for (const FlameInput input :
       {FlameInput::kPressureRate, FlameInput::kPressure, FlameInput::kVelocity}) {
    RecordsFitOptions of_this = options;
    of_this.key += std::string(FlameInputName(input)) + "/";
    TryInput(input, records, spec, of_this, &out);
  }
  return out;
}

}  // namespace howl
