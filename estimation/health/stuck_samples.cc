#include "estimation/health/stuck_samples.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "estimation/analysis/instruments/fill_gaps.h"
#include "estimation/health/sample_health.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

double ShareOf(const std::vector<Gap>& gaps, std::size_t size) {
  std::size_t lost = 0;
  for (const Gap& gap : gaps) lost += gap.length;
  return static_cast<double>(lost) / static_cast<double>(std::max<std::size_t>(size, 1));
}

}  // namespace

double ShareStuck(std::span<const double> samples) {
  return ShareOf(StuckSamples(samples), samples.size());
}

std::vector<LoopRecord> WithStuckSamplesFilled(std::vector<LoopRecord> records,
                                               const std::vector<std::string>& withheld,
                                               int threads) {
  const auto gaps_of = [&](const std::vector<double>& samples, const char* effect) {
    std::vector<Gap> out;
    if (std::ranges::find(withheld, effect) == withheld.end()) out = StuckSamples(samples);
    if (ShareOf(out, samples.size()) > kMostStuck) out.clear();
    return out;
  };
  RunUnits(records.size(), threads, [&](std::size_t e) {
    LoopRecord& each = records[e];
    const std::vector<Gap> p = gaps_of(each.record.pressure, "p_dropouts");
    const std::vector<Gap> q = gaps_of(each.record.heat_release, "q_dropouts");
    each.record = WithGapsFilled(std::move(each.record), p, q, each.cycle_hz);
  });
  return records;
}

}  // namespace howl
