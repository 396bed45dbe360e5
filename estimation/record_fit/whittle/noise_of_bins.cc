#include "estimation/record_fit/whittle/noise_of_bins.h"

namespace howl {
namespace {

DirectionTerms TermsOf(LoopNoise source, double background_ratio) {
  const NoiseDirection still = DirectionOf(source, 0.0, 0.0, background_ratio);
  const NoiseTurn turn = TurnOf(source, background_ratio);
  return {still.acoustic.real(), turn.by_r, still.flame.real(), turn.by_f};
}

DirectionProducts ProductsOf(const DirectionTerms& of) {
  const auto& [a0, a1, b0, b1] = of;
  return {a0 * a0, a0 * a1, a1 * a1, b0 * b0, b0 * b1, b1 * b1, a0 * b0, a0 * b1, a1 * b0, a1 * b1};
}

}  // namespace

NoiseOfBins::NoiseOfBins(const std::vector<NoiseTerm>& noise, double background_ratio)
    : count(static_cast<Eigen::Index>(noise.size())), ratio(background_ratio) {
  for (std::size_t j = 0; j < noise.size(); ++j) {
    terms[j] = TermsOf(noise[j].source, background_ratio);
    products[j] = ProductsOf(terms[j]);
    if (noise[j].source == LoopNoise::kBackground) background = static_cast<Eigen::Index>(j);
  }
}

}  // namespace howl
