// The typical power around a bin, which a line in it does not raise: the median of |E|^2, as the
// mean of the exponential distribution that noise has.
#ifndef HOWL_DIAGNOSIS_NUMERICS_LOCAL_POWER_H_
#define HOWL_DIAGNOSIS_NUMERICS_LOCAL_POWER_H_

#include <Eigen/Core>

namespace howl {

// Over the bins within `reach` of `bin`, those within `gap` left out (a negative gap: none).
double LocalPower(const Eigen::VectorXd& power, Eigen::Index bin, Eigen::Index reach,
                  Eigen::Index gap = -1);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_NUMERICS_LOCAL_POWER_H_
