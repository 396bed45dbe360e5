// A duct of K modes closed by a flame that sits at one place of it, as a delay system
// (delay_system.h): a Rijke tube and a ducted flame alike.
//
//   y_k' = w_k p_k,     p_k' = -w_k y_k - 2 xi_k w_k p_k + N_k q,     w_k = 2 pi omega_k
//
// so that p_k answers to q by N_k s / (s^2 + 2 xi_k w_k s + w_k^2), as in acoustics.h, and y_k, w_k
// times its integral, is the mode's velocity in units of pressure. What drives the flame is, at its
// place,
//
//   pressure   v = sum_k a_k p_k
//   velocity   v = sum_k a_k y_k      (momentum: rho u' = -dp/dx; a_k has the mode's shape)
//
// and the flame is n-tau with a low-pass, then static:
//
//   q = lambda Phi(m),     m' = 2 pi f_c (v(t - tau) - m);     m = v(t - tau) without a low-pass
//
// (L. Crocco and S.-I. Cheng, Theory of Combustion Instability, 1956: n is -Phi'(0) in units of its
// own; T. Schuller, D. Durox and S. Candel, Combust. Flame 134:21, 2003: the low-pass.) The
// parameter of the delay system is lambda, the flame's strength.
//
// A flame that p' drives makes a system of neutral type, which these are not: harmonic_balance.h,
// poles.h and simulate.h are for that.
//
// Units as in acoustics.h and flame.h; time in seconds.
#ifndef HOWL_MODEL_DELAY_SYSTEMS_DUCT_FLAME_H_
#define HOWL_MODEL_DELAY_SYSTEMS_DUCT_FLAME_H_

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "model/delay_systems/delay_system.h"
#include "model/loop/flame.h"

namespace howl {

enum class FlameDrive : std::uint8_t { kPressure, kVelocity };

struct DuctMode {
  double omega_hz = 0.0;
  double xi = 0.0;
  double N = 0.0;         // of q in the mode
  double at_flame = 1.0;  // a_k: of the mode in what drives the flame
};

struct DuctFlame {
  std::vector<DuctMode> modes;
  FlameDrive drive = FlameDrive::kPressure;
  Flame<double> flame;
  double tau_s = 0.0;
  double cutoff_hz = std::numeric_limits<double>::infinity();  // f_c of the low-pass
};

// States y_1 .. y_K, p_1 .. p_K, and m where there is a low-pass.
DelaySystem MakeDelaySystem(const DuctFlame& duct);

// c with v = c . x for a state x.
Eigen::VectorXd DriveOf(const DuctFlame& duct);

}  // namespace howl

#endif  // HOWL_MODEL_DELAY_SYSTEMS_DUCT_FLAME_H_
