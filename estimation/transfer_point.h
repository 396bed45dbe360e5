// One frequency of the complex transfer H = p / q.
#ifndef HOWL_ESTIMATION_TRANSFER_POINT_H_
#define HOWL_ESTIMATION_TRANSFER_POINT_H_

#include <Eigen/Core>

namespace howl {

struct TransferPoint {
  double frequency_hz = 0.0;
  double spread_hz = 0.0;     // standard deviation of the frequencies that the point averages
  double re = 0.0, im = 0.0;  // units of p per unit of q
  double variance_re = 0.0, variance_im = 0.0, covariance = 0.0;
  double coherence = 0.0;           // magnitude squared, free of its bias by few averages
  double degrees_of_freedom = 0.0;  // independent complex averages
  double q_noise_bias = 0.0;        // relative: what was added to |H| for q's own noise floor
  double weight = 0.0;              // power of p at the point, coherent with q

  Eigen::Matrix2d Covariance() const {
    Eigen::Matrix2d m;
    m << variance_re, covariance, covariance, variance_im;
    return m;
  }
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_TRANSFER_POINT_H_
