#include "estimation/record_fit/starts/raise_noise.h"

#include <cmath>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/whittle/whittle.h"

namespace howl {

// ln L = c - 2 n x - Q e^(-x) at x above the level.
void RaiseNoise(const RecordSpectra& record, const PointStructure& structure, LoopPoint* point) {
  const auto log_likelihood = [&](double x) {
    LoopPoint moved = *point;
    for (Eigen::VectorXd& source : moved.noise) source[0] += x;
    return WhittleLogLikelihood(structure.noise, record.share,
                                ResidualsOf(record, structure, moved));
  };
  const double twice_bins = 2.0 * record.share.sum();
  const double square =
      (log_likelihood(1.0) - log_likelihood(0.0) + twice_bins) / (1.0 - std::exp(-1.0));
  if (!(square > twice_bins)) return;
  for (Eigen::VectorXd& source : point->noise) source[0] += std::log(square / twice_bins);
}

}  // namespace howl
