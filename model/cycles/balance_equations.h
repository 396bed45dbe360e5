// The equations of harmonic balance and their Jacobian, shared by the solver and the continuation.
//
//   r_1 = 1 - L_1 Q_1 / V_1,    r_k = (V_k - L_k Q_k) / v_s,  k = 2 .. H
//
// with v_s = Q / |Phi slope|. Dividing the first by V_1 (real) keeps it regular where the cycle
// shrinks to nothing. Unknowns u: Re V_1 / v_s, Re V_k / v_s, Im V_k / v_s for k = 2 .. H, and
// ln(f / 1 Hz); real residuals: Re r_1, Im r_1, Re r_2, ... Jacobian of Q by the Fourier
// coefficients g_n of Phi'(v(t)): dQ_k = sum_m g_(k-m) dV_m + g_(k+m) conj(dV_m).
#ifndef HOWL_MODEL_CYCLES_BALANCE_EQUATIONS_H_
#define HOWL_MODEL_CYCLES_BALANCE_EQUATIONS_H_

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "model/cycles/harmonic_balance.h"

namespace howl::internal {

struct BalanceState {
  std::vector<std::complex<double>> rate;  // V_k, k = 0 .. H
  double frequency_hz = 0.0;
};

double RateScale(const Flame<double>& flame);
Eigen::VectorXd PackState(const BalanceState& state, double rate_scale);
BalanceState UnpackState(const Eigen::VectorXd& u, double rate_scale);

// Residuals at the state; the Jacobian with respect to u as well unless it is null.
Eigen::VectorXd BalanceResiduals(const ClosedLoop& model, const BalanceState& state,
                                 Eigen::MatrixXd* jacobian);

double Tail(const std::vector<std::complex<double>>& rate);

// Completes q and p from v.
LimitCycle MakeLimitCycle(const ClosedLoop& model, const BalanceState& state);

}  // namespace howl::internal

#endif  // HOWL_MODEL_CYCLES_BALANCE_EQUATIONS_H_
