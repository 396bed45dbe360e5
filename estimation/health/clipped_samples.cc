#include "estimation/health/clipped_samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "estimation/analysis/instruments/draw_clipped.h"
#include "estimation/health/sample_health.h"
#include "estimation/parallel.h"
#include "estimation/unit_seed.h"

namespace howl {
namespace {

bool IsClipped(const RangeEnds& ends) {
  return std::isfinite(ends.lower) || std::isfinite(ends.upper);
}

double ShareBeyond(const RangeEnds& ends, std::span<const double> samples) {
  if (!IsClipped(ends)) return 0.0;
  const auto beyond = std::ranges::count_if(
      samples, [&](double value) { return value <= ends.lower || value >= ends.upper; });
  return static_cast<double>(beyond) / static_cast<double>(samples.size());
}

}  // namespace

double ShareClipped(std::span<const double> pressure) {
  return ShareBeyond(RepeatedEnds(pressure), pressure);
}

std::vector<LoopRecord> WithClippedSamplesDrawn(std::vector<LoopRecord> records,
                                                const std::vector<std::string>& withheld,
                                                std::uint64_t seed, int threads) {
  if (std::ranges::find(withheld, "p_clipping") != withheld.end()) return records;
  RunUnits(records.size(), threads, [&](std::size_t e) {
    LoopRecord& each = records[e];
    const RangeEnds ends = RepeatedEnds(each.record.pressure);
    const double share = ShareBeyond(ends, each.record.pressure);
    if (share == 0.0 || share > kMostClipped) return;
    each.record =
        WithClippedDrawn(std::move(each.record), ends, each.cycle_hz, UnitSeed(seed, "clipped", e));
  });
  return records;
}

}  // namespace howl
