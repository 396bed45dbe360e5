// The acoustics that a record's broadband q-to-p transfer allows an experiment: an ellipsoid in the
// offsets from the transfer's fit (omega_0, xi_0, N_0, M_0),
//
//   v = (ln omega / omega_0, ln xi / xi_0, N / N_0 - 1, M / M_0 - 1),   v^T C^-1 v <= distance^2,
//
// where C is the covariance of the transfer's fit, widened by its misfit
// (estimation/analysis/transfer/transfer.h). G is linear in N and M, so that the errors of these
// are normal in themselves; in their logarithms a truth far below the fit would count as much
// farther off than it is. A parameter that the transfer does not determine is left out, as is M
// where the model has one mode: what is then tested is the marginal of the others.
#ifndef HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_ELLIPSOID_H_
#define HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_ELLIPSOID_H_

#include <Eigen/Core>
#include <array>
#include <optional>

#include "estimation/parameters.h"

namespace howl {

struct TransferFit;

inline constexpr int kNumTransferParameters = 4;  // omega_hz, xi, N, M: the order of v
using TransferVector = Eigen::Matrix<double, kNumTransferParameters, 1>;
using TransferMatrix = Eigen::Matrix<double, kNumTransferParameters, kNumTransferParameters>;

// Whether the k-th offset is a logarithm; else it is a share of the centre.
inline constexpr bool IsLogOffset(int k) { return k < 2; }

class TransferEllipsoid {
 public:
  TransferEllipsoid() = default;
  // centre: positive, in natural units. covariance: of the offsets. determined: which of the four
  // count. No value where the covariance of these is not positive.
  static std::optional<TransferEllipsoid> Make(
      const TransferVector& centre, const TransferMatrix& covariance,
      const std::array<bool, kNumTransferParameters>& determined);

  const TransferVector& Centre() const { return centre_; }
  const TransferMatrix& Covariance() const { return covariance_; }
  bool IsDetermined(int k) const { return determined_[static_cast<std::size_t>(k)]; }

  // How many parameters count.
  int Count(bool second_mode) const;

  // Upper triangular U with C^-1 = U^T U over what counts; rows and columns of what does not are
  // zero.
  const TransferMatrix& Factor(bool second_mode) const { return second_mode ? two_ : one_; }

 private:
  TransferVector centre_ = TransferVector::Ones();
  TransferMatrix covariance_ = TransferMatrix::Zero();
  std::array<bool, kNumTransferParameters> determined_{};
  TransferMatrix one_ = TransferMatrix::Zero();
  TransferMatrix two_ = TransferMatrix::Zero();
};

// The ellipsoid of a fit; no value where no parameter is determined. A parameter counts when its
// relative standard deviation is below `largest_relative_std`: beyond that a normal error does not
// describe what the transfer says.
std::optional<TransferEllipsoid> MakeTransferEllipsoid(const TransferFit& fit,
                                                       double largest_relative_std = 0.5);

// The root of the quadratic form above.
double MahalanobisDistance(const TransferEllipsoid& ellipsoid, const LoopModel& model);

// The same in standard deviations of one number (estimation/analysis/transfer/joint_deviation.h):
// what transfer_distance_max limits.
double TransferDistance(const TransferEllipsoid& ellipsoid, const LoopModel& model);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_ELLIPSOID_H_
