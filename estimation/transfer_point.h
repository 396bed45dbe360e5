// One frequency of the complex transfer H = p / q. Its error has two parts:
//
//   H = (1 + k b u) G + e
//
// e: the point's own scatter, independent of that of others but for the overlap of neighbours;
// u: one unknown of unit variance for all points of a record, the level S of q's own noise. Half of
// its bound S_n was taken out of S_qq, which changed |H| by b, relative, and S = (1 - k u) S_n / 2.
#ifndef HOWL_ESTIMATION_TRANSFER_POINT_H_
#define HOWL_ESTIMATION_TRANSFER_POINT_H_

#include <Eigen/Core>

namespace howl {

// k: the level lies anywhere between none and its bound, and an interval has to hold the truth
// wherever the level lies. With a scatter s of their own, values that a level at either end moves
// by one are within 1.96 sqrt(k^2 + s^2) in 95 % of the cases when k is 0.9, at the worst s, near
// one. The deviation of a uniform distribution, 0.58, leaves 83 % there.
inline constexpr double kQNoiseLevelStd = 0.9;

struct TransferPoint {
  double frequency_hz = 0.0;
  double spread_hz = 0.0;     // standard deviation of the frequencies that the point averages
  double re = 0.0, im = 0.0;  // units of p per unit of q
  double variance_re = 0.0, variance_im = 0.0, covariance = 0.0;  // of the point's own scatter
  double coherence = 0.0;           // magnitude squared, free of its bias by few averages
  double degrees_of_freedom = 0.0;  // independent complex averages
  double q_noise_bias = 0.0;        // relative: what was added to |H| for q's own noise floor
  double weight = 0.0;              // power of p at the point, coherent with q

  Eigen::Matrix2d Covariance() const {
    Eigen::Matrix2d m;
    m << variance_re, covariance, covariance, variance_im;
    return m;
  }

  // Of one point by itself.
  Eigen::Matrix2d TotalCovariance() const {
    const Eigen::Vector2d shift = kQNoiseLevelStd * q_noise_bias * Eigen::Vector2d(re, im);
    return Covariance() + shift * shift.transpose();
  }
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_TRANSFER_POINT_H_
