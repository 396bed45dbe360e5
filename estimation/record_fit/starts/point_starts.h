// Where fits of one operating point begin (point_fit.h): poles from cut A (pole_starts.h), delays
// from cut B, whose flame is linear once the delay is given, each with the other. What the two cuts
// leave over starts the noise.
#ifndef HOWL_ESTIMATION_RECORD_FIT_STARTS_POINT_STARTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_STARTS_POINT_STARTS_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/loop/point_prior.h"

namespace howl {

// At least four; `count` in all, the further ones with poles that are drawn.
std::vector<Eigen::VectorXd> StartsOf(const RecordSpectra& record, const PointStructure& structure,
                                      const PointPrior& prior, std::size_t count,
                                      std::uint64_t seed);

// The ratio at which p and q show alike what is coherent between them without a delay, over the
// band's quiet bins, and the logarithm of q's level in those.
struct BackgroundStart {
  double ratio = 0.0;
  double log_level = 0.0;
};
BackgroundStart BackgroundOf(const RecordSpectra& record);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_STARTS_POINT_STARTS_H_
