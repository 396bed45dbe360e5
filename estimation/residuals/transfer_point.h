// One point of the measured q-to-p transfer as a residual of the joint fit: the full form (5a) at
// any frequency where p and q are coherent, not at the limit cycle alone,
//
//   r = L^-1 [Re; Im] (G - H),      G = (G(j 2 pi (f - d)) + G(j 2 pi (f + d))) / 2
//
// with L L^T the covariance of [Re H; Im H]. The point averages frequencies of standard deviation
// d: the mean of two at that distance has their second moment, so that a narrow resonance is not
// taken for a more damped one.
//
// Two residuals. Parameters: log omega_hz, log xi, log N, log M, one block of size 1 each.
#ifndef HOWL_ESTIMATION_RESIDUALS_TRANSFER_POINT_H_
#define HOWL_ESTIMATION_RESIDUALS_TRANSFER_POINT_H_

#include <ceres/autodiff_cost_function.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "estimation/transfer_point.h"
#include "model/acoustics.h"

namespace howl {

class TransferPointResidual {
 public:
  TransferPointResidual(const TransferPoint& point, double harmonic_ratio)
      : frequency_hz_(point.frequency_hz),
        spread_hz_(point.spread_hz),
        response_(point.re, point.im),
        harmonic_ratio_(harmonic_ratio) {
    const Eigen::LLT<Eigen::Matrix2d> factor(point.Covariance());
    CHECK(factor.info() == Eigen::Success) << "covariance of a transfer point is not positive";
    whitening_ = factor.matrixL().solve(Eigen::Matrix2d::Identity());
  }

  static ceres::CostFunction* Create(const TransferPoint& point,
                                     double harmonic_ratio = kSeedHarmonicRatio) {
    return new ceres::AutoDiffCostFunction<TransferPointResidual, 2, 1, 1, 1, 1>(
        new TransferPointResidual(point, harmonic_ratio));
  }

  template <typename T>
  bool operator()(const T* log_omega_hz, const T* log_xi, const T* log_N, const T* log_M,
                  T* residual) const {
    using std::exp;
    const Acoustics<T> acoustics{exp(*log_omega_hz), exp(*log_xi), exp(*log_N), exp(*log_M),
                                 T(harmonic_ratio_)};
    const Complex<T> model = T(0.5) * (AcousticResponse(acoustics, T(frequency_hz_ - spread_hz_)) +
                                       AcousticResponse(acoustics, T(frequency_hz_ + spread_hz_)));
    const T re = model.re - response_(0);
    const T im = model.im - response_(1);
    residual[0] = whitening_(0, 0) * re + whitening_(0, 1) * im;
    residual[1] = whitening_(1, 0) * re + whitening_(1, 1) * im;
    return true;
  }

 private:
  double frequency_hz_;
  double spread_hz_;
  Eigen::Vector2d response_;
  Eigen::Matrix2d whitening_;
  double harmonic_ratio_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_TRANSFER_POINT_H_
