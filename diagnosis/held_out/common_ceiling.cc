#include "diagnosis/held_out/common_ceiling.h"

#include <algorithm>
#include <cmath>

namespace howl {
namespace {

// Bands of p stand before as many of q.
std::size_t FirstBand(const std::vector<BandErrors>& bands, std::size_t signal) {
  return signal * (bands.size() / 2);
}

}  // namespace

void CommonCeiling::Lower(const HeldOutScore& score) {
  least_.resize(score.errors.size());
  for (std::size_t e = 0; e < score.errors.size(); ++e) {
    for (std::size_t signal = 0; signal < 2; ++signal) {
      Least here;
      double sum = 0.0;
      double count = 0.0;
      for (std::size_t half = 0; half < 2; ++half) {
        const std::vector<BandErrors>& bands = score.errors[e][half];
        for (std::size_t i = 0; i < bands.size() / 2; ++i) {
          const double ceiling = bands[FirstBand(bands, signal) + i].ceiling;
          here.ceilings[half].push_back(ceiling);
          sum += std::log(ceiling);
          count += 1.0;
        }
      }
      here.mean_log = sum / count;
      if (here.mean_log < least_[e][signal].mean_log) least_[e][signal] = std::move(here);
    }
  }
}

HeldOutScore CommonCeiling::Against(HeldOutScore score) const {
  for (std::size_t e = 0; e < score.errors.size(); ++e) {
    for (std::size_t signal = 0; signal < 2; ++signal) {
      for (std::size_t half = 0; half < 2; ++half) {
        std::vector<BandErrors>& bands = score.errors[e][half];
        const std::vector<double>& ceilings = least_[e][signal].ceilings[half];
        for (std::size_t i = 0; i < ceilings.size(); ++i) {
          bands[FirstBand(bands, signal) + i].ceiling = ceilings[i];
        }
      }
    }
  }
  return score;
}

double CommonCeiling::Gap(const HeldOutScore& score) const {
  return std::max(Against(score).Gap(), 0.0);
}

}  // namespace howl
