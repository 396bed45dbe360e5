// Acoustics of K modes, each with a frequency, damping and residue of its own, p measured anywhere:
//
//   R(s) = sum_k (N_k s + B_k w_k) / (s^2 + 2 xi_k w_k s + w_k^2),     w_k = 2 pi omega_k
//
// N_k as in the paper's (5a); B_k is what a probe away from the flame, or a mean flow, adds to it.
// Hz, and units of p per unit of q times rad/s.
#ifndef HOWL_MODEL_LOOP_MODAL_ACOUSTICS_H_
#define HOWL_MODEL_LOOP_MODAL_ACOUSTICS_H_

#include <complex>
#include <span>

#include "model/numerics/units.h"

namespace howl {

struct ResidueMode {
  double omega_hz = 0.0;
  double xi = 0.0;
  double N = 0.0;
  double B = 0.0;
};

// R at s, in rad/s.
inline std::complex<double> ModalResponse(std::span<const ResidueMode> modes,
                                          std::complex<double> s) {
  std::complex<double> sum = 0.0;
  for (const ResidueMode& mode : modes) {
    const double w = kRadPerSPerHz * mode.omega_hz;
    sum += (mode.N * s + mode.B * w) / (s * s + 2.0 * mode.xi * w * s + w * w);
  }
  return sum;
}

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_MODAL_ACOUSTICS_H_
