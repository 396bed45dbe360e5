// Whether a fit from elsewhere comes to a better maximum than a known one.
#ifndef HOWL_ESTIMATION_RECORD_FIT_OTHER_STARTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_OTHER_STARTS_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/record_fit/loop/point_prior.h"
#include "estimation/record_fit/point_fit.h"

namespace howl {

// Nats that a search must have found to be worth another from there.
inline constexpr double kWorthAnother = 1.0;

// `fit`, or what is more likely of the fits from these starts. All go to the maximum of the
// record's middle (middle_part.h), and the most likely of them on to that of the whole where it is
// more likely there than `fit` is.
PointFit BestWith(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, PointFit fit, const std::vector<Eigen::VectorXd>& starts,
                  const PointFitOptions& options = {});

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_OTHER_STARTS_H_
