// The value of whittle.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "estimation/record_fit/whittle/log_of_product.h"
#include "estimation/record_fit/whittle/noise_lanes.h"
#include "estimation/record_fit/whittle/whittle.h"

namespace howl {
namespace {

constexpr Eigen::Index kBinsAtOnce = 64;

struct Chunk {
  std::array<double, kBinsAtOnce> determinant;  // of Sigma
  std::array<double, kBinsAtOnce> square;       // E^H Sigma^-1 E
};

// Of the bins from i on, as many as V has lanes.
template <typename V>
HOWL_IN_CLONES void EvaluateLanes(const NoiseOfBins& noise, const LoopResiduals& at, Eigen::Index i,
                                  double* determinant, double* square) {
  const CovarianceLanes<V> sigma(noise, at, i);
  const auto acoustic = ComplexLanes<V>::Load(at.acoustic.data() + i);
  const auto flame = ComplexLanes<V>::Load(at.flame.data() + i);
  const V of_sigma = sigma.Determinant();
  const V adjugate = sigma.bb * SquaredMagnitude(acoustic) + sigma.aa * SquaredMagnitude(flame) -
                     2.0 * ConjugateTimes(acoustic, sigma.ab * flame).re;
  Lanes<V>::Store(of_sigma, determinant);
  Lanes<V>::Store(adjugate / of_sigma, square);
}

HOWL_VECTOR_CLONES void Evaluate(const NoiseOfBins& noise, const LoopResiduals& at,
                                 Eigen::Index first, Eigen::Index bins, Chunk* out) {
  Eigen::Index i = 0;
  for (; i + kLanes <= bins; i += kLanes) {
    EvaluateLanes<EightLanes>(noise, at, first + i, out->determinant.data() + i,
                              out->square.data() + i);
  }
  for (; i < bins; ++i) {
    EvaluateLanes<double>(noise, at, first + i, out->determinant.data() + i,
                          out->square.data() + i);
  }
}

}  // namespace

double WhittleLogLikelihood(const std::vector<NoiseTerm>& noise, const Eigen::VectorXd& share,
                            const LoopResiduals& at) {
  const NoiseOfBins of_bins(noise, at.background_ratio);
  LogOfProduct determinants;
  double squares = 0.0;
  Chunk chunk;
  for (Eigen::Index first = 0; first < share.size(); first += kBinsAtOnce) {
    const Eigen::Index bins = std::min(kBinsAtOnce, share.size() - first);
    Evaluate(of_bins, at, first, bins, &chunk);
    for (Eigen::Index i = 0; i < bins; ++i) {
      const auto at_i = static_cast<std::size_t>(i);
      const double weight = share[first + i];
      if (!(chunk.determinant[at_i] > 0.0)) return -std::numeric_limits<double>::infinity();
      determinants.Multiply(chunk.determinant[at_i], weight);
      squares += weight * chunk.square[at_i];
    }
  }
  const double sum = -determinants.Sum() - squares;
  return std::isfinite(sum) ? sum : -std::numeric_limits<double>::infinity();
}

}  // namespace howl
