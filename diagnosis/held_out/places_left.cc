#include "diagnosis/held_out/places_left.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace howl {
namespace {

constexpr double kMost = 0.8;

// One signal's bands at each operating point: the excess of squares over the ceiling's, mean over
// the halves.
struct Excess {
  std::vector<std::vector<double>> of_points;
  std::vector<double> sum;
};

// A record's bands are those of p, then as many of q.
Excess ExcessOf(const HeldOutScore& score, bool heat_release) {
  Excess out;
  std::size_t count = score.errors[0][0].size() / 2;
  for (const auto& halves : score.errors) {
    for (const std::vector<BandErrors>& half : halves) count = std::min(count, half.size() / 2);
  }
  out.sum.assign(count, 0.0);
  for (const auto& halves : score.errors) {
    std::vector<double> of_point(count, 0.0);
    for (const std::vector<BandErrors>& half : halves) {
      const std::size_t first = heat_release ? half.size() / 2 : 0;
      for (std::size_t i = 0; i < count; ++i) {
        const BandErrors& band = half[first + i];
        of_point[i] += 0.5 * std::max(band.error / band.ceiling - 1.0, 0.0);
      }
    }
    for (std::size_t i = 0; i < count; ++i) out.sum[i] += of_point[i];
    out.of_points.push_back(std::move(of_point));
  }
  return out;
}

// First and one beyond the last.
using Run = std::pair<std::size_t, std::size_t>;

Run ShortestRun(const std::vector<double>& of_bands) {
  const double most = kMost * std::accumulate(of_bands.begin(), of_bands.end(), 0.0);
  Run best = {0, of_bands.size()};
  for (std::size_t from = 0; from < of_bands.size(); ++from) {
    double held = 0.0;
    for (std::size_t to = from; to < of_bands.size(); ++to) {
      held += of_bands[to];
      if (held < most) continue;
      if (to + 1 - from < best.second - best.first) best = {from, to + 1};
      break;
    }
  }
  return best;
}

}  // namespace

HeldOutScore Beside(HeldOutScore score, const HeldOutScore& other) {
  for (std::size_t e = 0; e < score.errors.size(); ++e) {
    for (std::size_t half = 0; half < 2; ++half) {
      std::vector<BandErrors>& bands = score.errors[e][half];
      for (std::size_t i = 0; i < bands.size(); ++i) {
        bands[i].ceiling = other.errors[e][half][i].error;
      }
    }
  }
  return score;
}

Place Everywhere(const std::vector<std::string>& names, const HeldOutScore& score) {
  Place out;
  out.experiments = names;
  const auto points = static_cast<double>(names.size());
  for (const auto& halves : score.errors) {
    out.low_hz += halves[0].front().low_hz / points;
    out.high_hz += halves[0].back().high_hz / points;
  }
  return out;
}

std::vector<Place> PlacesLeft(const std::vector<std::string>& names, const HeldOutScore& score) {
  std::vector<Place> out;
  double total = 0.0;
  const auto points = static_cast<double>(names.size());
  for (const bool heat_release : {false, true}) {
    const Excess excess = ExcessOf(score, heat_release);
    Place place;
    place.block = heat_release ? LoopBlock::kFlame : LoopBlock::kAcoustics;
    place.share = std::accumulate(excess.sum.begin(), excess.sum.end(), 0.0);
    total += place.share;
    if (place.share <= 0.0) continue;
    const Run run = ShortestRun(excess.sum);
    std::vector<double> within;
    for (std::size_t e = 0; e < names.size(); ++e) {
      const std::vector<BandErrors>& bands = score.errors[e][0];
      place.low_hz += bands[run.first].low_hz / points;
      place.high_hz += bands[run.second - 1].high_hz / points;
      const auto first = excess.of_points[e].begin();
      within.push_back(std::accumulate(first + static_cast<std::ptrdiff_t>(run.first),
                                       first + static_cast<std::ptrdiff_t>(run.second), 0.0));
    }
    const double mean = std::accumulate(within.begin(), within.end(), 0.0) / points;
    for (std::size_t e = 0; e < names.size(); ++e) {
      if (within[e] >= mean) place.experiments.push_back(names[e]);
    }
    out.push_back(std::move(place));
  }
  for (Place& place : out) place.share /= total;
  std::ranges::stable_sort(out, std::ranges::greater(), &Place::share);
  return out;
}

}  // namespace howl
