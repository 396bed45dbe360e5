#include "diagnosis/held_out/common_ceiling.h"

#include <algorithm>
#include <limits>

namespace howl {

void CommonCeiling::Lower(const HeldOutScore& score) {
  least_.resize(score.errors.size());
  for (std::size_t e = 0; e < score.errors.size(); ++e) {
    for (std::size_t half = 0; half < 2; ++half) {
      std::vector<double>& least = least_[e][half];
      const std::vector<BandErrors>& bands = score.errors[e][half];
      least.resize(bands.size(), std::numeric_limits<double>::infinity());
      for (std::size_t i = 0; i < bands.size(); ++i) {
        least[i] = std::min(least[i], bands[i].ceiling);
      }
    }
  }
}

HeldOutScore CommonCeiling::Against(HeldOutScore score) const {
  for (std::size_t e = 0; e < score.errors.size(); ++e) {
    for (std::size_t half = 0; half < 2; ++half) {
      for (std::size_t i = 0; i < least_[e][half].size(); ++i) {
        score.errors[e][half][i].ceiling = least_[e][half][i];
      }
    }
  }
  return score;
}

double CommonCeiling::Gap(const HeldOutScore& score) const {
  return std::max(Against(score).Gap(), 0.0);
}

}  // namespace howl
