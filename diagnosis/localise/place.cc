#include "diagnosis/localise/place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/verdict/verdict.h"

namespace howl {
namespace {

constexpr double kTemperature = 3.0;
constexpr double kTemperatureShare = 0.02;

struct Score {
  LoopBlock block;
  double gain;
};

void Raise(LoopBlock block, double gain, std::vector<Score>* scores) {
  const auto same = std::find_if(scores->begin(), scores->end(),
                                 [&](const Score& score) { return score.block == block; });
  if (same == scores->end()) {
    scores->push_back({block, gain});
  } else {
    same->gain = std::max(same->gain, gain);
  }
}

}  // namespace

std::vector<Place> FindPlaces(const std::vector<CutRecord>& records,
                              const std::vector<Attempt>& attempts, VerdictKind kind,
                              const Slack& before, const std::vector<BlockSlack>& blocks) {
  const bool acoustic = before.acoustic_excess > 0.1 * before.flame_excess;
  const bool flame = before.flame_excess > std::max(kFlameAllowance, 0.1 * before.acoustic_excess);
  std::vector<Score> scores;
  for (const Attempt& attempt : attempts) {
    Raise(attempt.candidate.block, std::max(0.0, attempt.candidate.gain), &scores);
  }
  double most_gain = 0.0;
  for (const BlockSlack& slack : blocks) {
    Raise(slack.block, std::max(0.0, slack.gain), &scores);
  }
  for (const Score& score : scores) most_gain = std::max(most_gain, score.gain);
  // A defect that was detected in a channel's samples needs no likelihood.
  for (const BlockSlack& slack : blocks) {
    if (slack.model_free) Raise(slack.block, 2.0 * most_gain + 10.0 * kTemperature, &scores);
  }
  double total = 0.0;
  if (kind == VerdictKind::kEffect) {
    // The blocks in which the probable effects act.
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
    // No model is exact, so distances count by their share of the largest gain too.
    const double temperature = kTemperature + kTemperatureShare * top;
    for (Score& score : scores) {
      score.gain = std::exp((score.gain - top) / temperature);
      total += score.gain;
    }
  }
  if (total <= 0.0) return {};
  // The band and the experiments come from the slack's map.
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
    Place place{score.block, low, high, names, score.gain / total};
    double best = 0.0;  // of the block's own forms
    for (const BlockSlack& slack : blocks) {
      if (slack.block != score.block || slack.high_hz == 0.0 || slack.gain <= best) continue;
      best = slack.gain;
      place.low_hz = slack.low_hz;
      place.high_hz = slack.high_hz;
    }
    places.push_back(std::move(place));
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.share > b.share; });
  return places;
}

}  // namespace howl
