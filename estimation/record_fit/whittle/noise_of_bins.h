// What the noise of all bins has in common. A source's direction is u = (a0 + a1 R, b0 + b1 F),
// with a1 and b1 as it turns. Sigma, and any u^H G u, are linear in the products of two of these
// numbers: a0^2, a0 a1, a1^2, b0^2, b0 b1, b1^2, a0 b0, a0 b1, a1 b0, a1 b1.
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_OF_BINS_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_OF_BINS_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "estimation/record_fit/whittle/noise_sources.h"

namespace howl {

inline constexpr std::size_t kDirectionProducts = 10;
using DirectionProducts = std::array<double, kDirectionProducts>;

struct DirectionTerms {
  double a0, a1, b0, b1;
};

struct NoiseOfBins {
  NoiseOfBins(const std::vector<NoiseTerm>& noise, double background_ratio);

  std::array<DirectionTerms, kMostNoiseTerms> terms;
  std::array<DirectionProducts, kMostNoiseTerms> products;
  Eigen::Index count = 0;
  Eigen::Index background = -1;  // which of them it is
  double ratio = 0.0;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_NOISE_OF_BINS_H_
