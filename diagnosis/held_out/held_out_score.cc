#include "diagnosis/held_out/held_out_score.h"

#include <cmath>

namespace howl {

double HeldOutScore::Nats(std::size_t half) const {
  double sum = 0.0;
  for (const auto& point : nats) sum += point[half];
  return sum;
}

double HeldOutScore::Gap(std::size_t half) const {
  double sum = 0.0;
  double count = 0.0;
  for (const auto& point : errors) {
    for (const BandErrors& band : point[half]) {
      sum += band.error / band.ceiling - 1.0;
      count += 1.0;
    }
  }
  return std::copysign(std::sqrt(std::abs(sum / count)), sum);
}

double HeldOutScore::Floor() const {
  double sum = 0.0;
  double count = 0.0;
  for (const auto& point : errors) {
    for (const std::vector<BandErrors>& half : point) {
      for (const BandErrors& band : half) {
        sum += band.spread / band.ceiling;
        count += 1.0;
      }
    }
  }
  return std::sqrt(sum / count);
}

double HeldOutScore::Gap() const {
  const double sum = std::abs(Gap(0)) * Gap(0) + std::abs(Gap(1)) * Gap(1);
  return std::copysign(std::sqrt(0.5 * std::abs(sum)), sum);
}

}  // namespace howl
