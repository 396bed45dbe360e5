// One point of the measured q-to-p transfer as a residual of the joint fit: the full form (5a) at
// any frequency where p and q are coherent, not at the limit cycle alone,
//
//   r = L^-1 [Re; Im] (G(j 2 pi f) - H),      L L^T = covariance of [Re H; Im H]
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
    const Complex<T> model = AcousticResponse(acoustics, T(frequency_hz_));
    const T re = model.re - response_(0);
    const T im = model.im - response_(1);
    residual[0] = whitening_(0, 0) * re + whitening_(0, 1) * im;
    residual[1] = whitening_(1, 0) * re + whitening_(1, 1) * im;
    return true;
  }

 private:
  double frequency_hz_;
  Eigen::Vector2d response_;
  Eigen::Matrix2d whitening_;
  double harmonic_ratio_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RESIDUALS_TRANSFER_POINT_H_
