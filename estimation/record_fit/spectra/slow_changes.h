// Parameters of a loop that change slowly within a record, in proportion to a known signal m:
//
//   damping     xi + sum_j xi_j m_j,     m_j = L_j (A^2 / mean A^2 - 1)
//   frequency   omega (1 + w m),         m = t / T - 1/2
//   delay       tau + sum_j tau_j m_j,   m_j = L_j (A / mean A - 1)
//   gain        1 + sum_j g_j m_j        of the flame's answer, with the same m_j
//
// A is the amplitude of p about its cycle, L_j lags of first order, of 1, 2.5 and 6 cycles. Their
// sums come near any memory with which a loop follows its amplitude, of several lags too, from none
// to some ten cycles. How near matters: with 1 and 6 alone, beside two lags of 2, what is missed of
// a strong effect passes for a source in the duct (2 200 nats of 15 500).
//
// Of a mode, x'' + 2 xi omega x' + omega^2 x = q and p = a x' + b omega x, and of what a flame
// gives out, q(t - tau), such changes are those of the heat release:
//
//   R (Q - sum_j k_j Z_j),   Z: m x' or m x (slow_signals.h),   k a = 2 xi_j omega or 2 w omega^2
//   Q + sum_j r_j Y_j,       Y: m dq/dt, to first order,        r_j = tau_j
//                            or -m q,                           r_j = g_j
//
// in the place of Q in cut A, and in the place of Q in cut B. A follows p, so that small signals
// near the cycle meet another loop than the mean one: on average over the cycle's phase, with L_j
// at the distance from the cycle,
//
//   Z_j = L_j P,   Y_j = 1/2 L_j s (Q_1 / P_1) P   or   -1/2 L_j (Q_1 / P_1) P
//
// with Q_1 / P_1 at the cycle, is what they add to the return difference (return_difference.h). A
// gain that follows at once is the flame's curve; one that lags meets slow changes of the amplitude
// only.
#ifndef HOWL_ESTIMATION_RECORD_FIT_SPECTRA_SLOW_CHANGES_H_
#define HOWL_ESTIMATION_RECORD_FIT_SPECTRA_SLOW_CHANGES_H_

#include <Eigen/Core>
#include <cstdint>

namespace howl {

enum class SlowChange : std::uint8_t { kDamping, kFrequency, kDelay, kGain };

// Of the signals m, those of one change.
struct SlowColumns {
  Eigen::Index first;
  Eigen::Index count;
};
constexpr SlowColumns ColumnsOf(SlowChange change) {
  switch (change) {
    case SlowChange::kDamping:
      return {0, 3};
    case SlowChange::kFrequency:
      return {3, 1};
    case SlowChange::kDelay:
      return {4, 3};
    case SlowChange::kGain:
      break;
  }
  return {7, 3};
}
inline constexpr Eigen::Index kSlowColumns = 10;

// A column each, in the order of SlowChange.
struct SlowSignals {
  Eigen::MatrixXcd signals;      // Z and Y on the edges of the record's bins
  Eigen::MatrixXcd of_pressure;  // over P, on its bins
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_SPECTRA_SLOW_CHANGES_H_
