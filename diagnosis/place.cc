#include "diagnosis/place.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace howl {
namespace {

constexpr double kFlameAllowance = 120.0;
constexpr double kTemperature = 3.0;

bool IsInstrument(LoopBlock block) {
  return block == LoopBlock::kPressureInstrument || block == LoopBlock::kHeatReleaseInstrument;
}

// Which cuts a block's error shows in.
bool Reaches(LoopBlock block, bool acoustic_cut) {
  if (IsInstrument(block)) return true;
  const bool acoustic = block == LoopBlock::kAcoustics || block == LoopBlock::kSource;
  return acoustic == acoustic_cut;
}

}  // namespace

std::vector<Place> FindPlaces(const std::vector<CutRecord>& records,
                              const std::vector<Attempt>& attempts, VerdictKind kind,
                              const Slack& before) {
  const bool acoustic = before.acoustic_excess > 0.1 * before.flame_excess;
  const bool flame = before.flame_excess > std::max(kFlameAllowance, 0.1 * before.acoustic_excess);
  struct Score {
    LoopBlock block;
    double gain;
  };
  std::vector<Score> scores;
  for (const Attempt& attempt : attempts) {
    double gain = std::max(0.0, attempt.candidate.gain);
    // No effect explains it: the place is where the cuts disagree with the model.
    if (kind == VerdictKind::kUnknown && acoustic && flame &&
        !IsInstrument(attempt.candidate.block)) {
      gain *= 0.3;
    }
    if (kind == VerdictKind::kUnknown && acoustic != flame &&
        (IsInstrument(attempt.candidate.block) || !Reaches(attempt.candidate.block, acoustic))) {
      gain *= 0.3;
    }
    auto same = std::find_if(scores.begin(), scores.end(), [&](const Score& score) {
      return score.block == attempt.candidate.block;
    });
    if (same == scores.end()) {
      scores.push_back({attempt.candidate.block, gain});
    } else {
      same->gain = std::max(same->gain, gain);
    }
  }
  double total = 0.0;
  if (kind == VerdictKind::kEffect) {
    // Where the probable effects act.
    for (Score& score : scores) {
      score.gain = 0.0;
      for (const Attempt& attempt : attempts) {
        if (attempt.candidate.block == score.block || attempt.also == score.block) {
          score.gain += attempt.candidate.probability;
        }
      }
      total += score.gain;
    }
  } else {
    double top = 0.0;
    for (const Score& score : scores) top = std::max(top, score.gain);
    const double temperature = kTemperature + 0.1 * top;
    for (Score& score : scores) {
      score.gain = std::exp((score.gain - top) / temperature);
      total += score.gain;
    }
  }
  if (total <= 0.0) return {};
  // The band and the experiments, from the slack's map.
  double low = records[0].frequency(0);
  double high = records[0].frequency(records[0].acoustic_count - 1);
  double most = 0.0;
  for (const SlackBand& band : before.acoustic) most = std::max(most, band.gain);
  if (acoustic && most > 10.0) {
    double first = std::numeric_limits<double>::infinity();
    double last = 0.0;
    for (const SlackBand& band : before.acoustic) {
      if (band.gain < 0.1 * most) continue;
      first = std::min(first, band.low_hz);
      last = std::max(last, band.high_hz);
    }
    low = first;
    high = last;
  }
  std::vector<double> by_experiment(records.size(), 0.0);
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (flame) by_experiment[e] += before.flame_by_experiment[e];
    for (const SlackBand& band : before.acoustic) by_experiment[e] += band.by_experiment[e];
  }
  const double largest = *std::max_element(by_experiment.begin(), by_experiment.end());
  std::vector<std::string> names;
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (by_experiment[e] >= 0.2 * largest) names.push_back(records[e].name);
  }
  std::vector<Place> places;
  for (const Score& score : scores) {
    if (score.gain / total < 0.02) continue;
    places.push_back({score.block, low, high, names, score.gain / total});
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.share > b.share; });
  return places;
}

}  // namespace howl
