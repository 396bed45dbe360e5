// Contractors: each narrows a cell by one condition without losing any member, and returns false
// when it leaves nothing. All need a RoundingGuard.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CONTRACT_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CONTRACT_H_

#include <array>
#include <vector>

#include "estimation/family/bounds/contract/cell.h"
#include "estimation/family/problem/problem.h"

namespace howl {

// An experiment's transfer ellipsoid, in the offsets of
// estimation/analysis/transfer/transfer_ellipsoid.h.
struct TransferBound {
  bool used = false;
  double distance = 0.0;  // widened by more than the rounding of the test
  TransferVector centre = TransferVector::Ones();
  TransferVector reach = TransferVector::Zero();  // half sides of the box around it
  // Of `factor`, where it counts all of the model's parameters: `whole` of them, else 0.
  TransferMatrix inverse = TransferMatrix::Zero();
  int whole = 0;
  Interval relative{0.0, kUnbounded};                // M / N over the ellipsoid
  TransferMatrix factor = TransferMatrix::Zero();    // upper triangular
  TransferMatrix backward = TransferMatrix::Zero();  // lower triangular, of the same form
};

// deviation_max: transfer_distance_max of the test.
TransferBound MakeTransferBound(const TransferEllipsoid& ellipsoid, bool second_mode,
                                double deviation_max);

// The k-th offset of a value, and the value of an offset.
Interval OffsetOf(const TransferBound& bound, int k, const Interval& value);
Interval ValueOf(const TransferBound& bound, int k, const Interval& offset);

// The constants of one experiment, as intervals that hold the exact values.
struct ContractTarget {
  Interval frequency_hz;
  Interval w_rad_s;
  Interval harmonic_ratio;
  Interval turns;  // 3 pi / 2 + 2 pi delay_periods
  double phi = 0.0;
  std::vector<Interval> lines_hz;
  bool has_line_error = false;
  Interval line_error_rad;  // second crossing tolerance
  // Least |G| at each line; empty where second_crossing_gain_min does not look at the experiment.
  std::vector<Interval> line_response_min;
  double second_mode_share_max = kUnbounded;
  TransferBound transfer;
};

// y = xi t (one mode).
bool ContractPhase(const ContractTarget& target, ExperimentBox& box);

// N = 2 |G| w xi exp(-asinh(xi t)) sqrt(1 + t^2) (one mode).
bool ContractGain(const ContractTarget& target, ExperimentBox& box);

// The two equations of two_mode_solve.h, and M = (M / N) N.
bool ContractTwoModes(const ContractTarget& target, ExperimentBox& box);

// w tau = turns - atan(t) - loop phase error.
bool ContractDelay(const ContractTarget& target, ExperimentBox& box);

// The loop's phase at every observed line, within its tolerance (two modes).
bool ContractLines(const ContractTarget& target, ExperimentBox& box);

// The transfer's distance.
bool ContractTransfer(const ContractTarget& target, ExperimentBox& box);

// The ellipsoid cut by the response's phase and gain: finer and dearer than ContractTransfer.
bool ContractSlabs(const ContractTarget& target, ExperimentBox& box);

// Whether a box of (omega, xi, N, M) may have a model near enough to the transfer; `always`: it has
// no other.
bool TransferMayHold(const TransferBound& bound, const std::array<Interval, 4>& box, bool* always);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CONTRACT_H_
