// The acoustics that a record's broadband q-to-p transfer allows an experiment: an ellipsoid in the
// logarithms v = (ln omega, ln xi, ln N, ln M),
//
//   (v - centre)^T C^-1 (v - centre) <= distance^2,
//
// where C is the covariance of the transfer's fit, widened by its misfit
// (estimation/analysis/transfer.h). A parameter that the transfer does not determine is left out,
// as is M where the model has one mode: what is then tested is the marginal of the others.
#ifndef HOWL_ESTIMATION_ANALYSIS_TRANSFER_ELLIPSOID_H_
#define HOWL_ESTIMATION_ANALYSIS_TRANSFER_ELLIPSOID_H_

#include <Eigen/Core>
#include <array>
#include <optional>

#include "estimation/parameters.h"

namespace howl {

struct TransferFit;

inline constexpr int kNumTransferParameters = 4;  // omega, xi, N, M: the order of v
using TransferVector = Eigen::Matrix<double, kNumTransferParameters, 1>;
using TransferMatrix = Eigen::Matrix<double, kNumTransferParameters, kNumTransferParameters>;

class TransferEllipsoid {
 public:
  TransferEllipsoid() = default;
  // determined: which of the four count. No value where the covariance of these is not positive.
  static std::optional<TransferEllipsoid> Make(
      const TransferVector& centre, const TransferMatrix& covariance,
      const std::array<bool, kNumTransferParameters>& determined);

  const TransferVector& Centre() const { return centre_; }
  const TransferMatrix& Covariance() const { return covariance_; }
  bool IsDetermined(int k) const { return determined_[static_cast<std::size_t>(k)]; }

  // Upper triangular U with C^-1 = U^T U over what counts; rows and columns of what does not are
  // zero.
  const TransferMatrix& Factor(bool second_mode) const { return second_mode ? two_ : one_; }

 private:
  TransferVector centre_ = TransferVector::Zero();
  TransferMatrix covariance_ = TransferMatrix::Zero();
  std::array<bool, kNumTransferParameters> determined_{};
  TransferMatrix one_ = TransferMatrix::Zero();
  TransferMatrix two_ = TransferMatrix::Zero();
};

// The ellipsoid of a fit; no value where no parameter is determined. A parameter counts when its
// relative standard deviation is below `largest_relative_std`: beyond that a normal error of its
// logarithm does not describe what the transfer says.
std::optional<TransferEllipsoid> MakeTransferEllipsoid(const TransferFit& fit,
                                                       double largest_relative_std = 0.5);

// In standard deviations: the root of the quadratic form above.
double TransferDistance(const TransferEllipsoid& ellipsoid, const LoopModel& model);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_TRANSFER_ELLIPSOID_H_
