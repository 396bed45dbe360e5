// One point of the measured q-to-p transfer as a residual of the joint fit: the full form (5a) at
// any frequency where p and q are coherent, not at the limit cycle alone,
//
//   r = L^-1 [Re; Im] ((1 + k b u) G - H),      G = (G(j 2 pi (f - d)) + G(j 2 pi (f + d))) / 2
//
// with L L^T the covariance of the point's own scatter, and k b u what the level of q's noise
// changes H by, u being one for all points of a record (estimation/transfer_point.h). It multiplies
// the model: multiplying H it would shrink the scatter with it, and a u that hides the noise would
// fit best. The point averages frequencies of standard deviation d: the mean of two at that
// distance has their second moment, so that a narrow resonance is not taken for a more damped one.
//
// Two residuals. Parameters, one block of size 1 each: u; log omega_hz, log xi, log N for one mode;
// and log M or log(M / N) for two. u has a prior of its own:
//
//   r = u
#ifndef HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_POINT_RESIDUAL_H_
#define HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_POINT_RESIDUAL_H_

#include <ceres/autodiff_cost_function.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "estimation/log_parameters.h"
#include "estimation/transfer_point.h"
#include "model/loop/acoustics.h"

namespace howl {

class TransferPointResidual {
 public:
  explicit TransferPointResidual(const TransferPoint& point, SecondMode second_mode = {})
      : frequency_hz_(point.frequency_hz),
        spread_hz_(point.spread_hz),
        response_(point.re, point.im),
        q_noise_std_(kQNoiseLevelStd * point.q_noise_bias),
        second_mode_(second_mode) {
    const Eigen::LLT<Eigen::Matrix2d> factor(point.Covariance());
    CHECK(factor.info() == Eigen::Success) << "covariance of a transfer point is not positive";
    whitening_ = factor.matrixL().solve(Eigen::Matrix2d::Identity());
  }

  static ceres::CostFunction* CreateReduced(const TransferPoint& point) {
    return new ceres::AutoDiffCostFunction<TransferPointResidual, 2, 1, 1, 1, 1>(
        new TransferPointResidual(point));
  }

  static ceres::CostFunction* CreateFull(const TransferPoint& point, SecondMode second_mode) {
    return new ceres::AutoDiffCostFunction<TransferPointResidual, 2, 1, 1, 1, 1, 1>(
        new TransferPointResidual(point, second_mode));
  }

  template <typename T>
  bool operator()(const T* q_noise, const T* log_omega_hz, const T* log_xi, const T* log_N,
                  T* residual) const {
    Evaluate(*q_noise, OneModeFromLogs(log_omega_hz, log_xi, log_N), residual);
    return true;
  }

  template <typename T>
  bool operator()(const T* q_noise, const T* log_omega_hz, const T* log_xi, const T* log_N,
                  const T* log_second, T* residual) const {
    Evaluate(*q_noise, TwoModesFromLogs(second_mode_, log_omega_hz, log_xi, log_N, log_second),
             residual);
    return true;
  }

 private:
  template <typename T>
  void Evaluate(const T& q_noise, const Acoustics<T>& acoustics, T* residual) const {
    const Complex<T> model = T(0.5) * (AcousticResponse(acoustics, T(frequency_hz_ - spread_hz_)) +
                                       AcousticResponse(acoustics, T(frequency_hz_ + spread_hz_)));
    const T level = T(1.0) + T(q_noise_std_) * q_noise;
    const T re = level * model.re - response_(0);
    const T im = level * model.im - response_(1);
    residual[0] = whitening_(0, 0) * re + whitening_(0, 1) * im;
    residual[1] = whitening_(1, 0) * re + whitening_(1, 1) * im;
  }

  double frequency_hz_;
  double spread_hz_;
  Eigen::Vector2d response_;
  double q_noise_std_;  // k b
  Eigen::Matrix2d whitening_;
  SecondMode second_mode_;
};

// The prior of u.
struct QNoiseLevelPrior {
  template <typename T>
  bool operator()(const T* q_noise, T* residual) const {
    *residual = *q_noise;
    return true;
  }

  static ceres::CostFunction* Create() {
    return new ceres::AutoDiffCostFunction<QNoiseLevelPrior, 1, 1>(new QNoiseLevelPrior);
  }
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_POINT_RESIDUAL_H_
