// A duct closed at the flame's end and open at the other. The wave that comes back to the flame's
// end after one round trip, T = 2 length / c, is spread by the open end's reflection; the heat
// release, itself spread along the duct, feeds it:
//
//   p(t) = sum_k R_k p(t - k d) + sum_k S_k q(t - k d)
//   G(s) = S(z) / (1 - R(z)),   z = e^(-s d)
//
// R_k < 0 gathers around k d = T: modes at odd multiples of a quarter wave, damped more the higher
// they are. R is the smoothest reflection for which the duct has two given poles; S, no longer than
// 1.6 round trips, leaves the first two modes with given strengths and extinguishes the others.
#ifndef HOWL_RIG_DUCT_H_
#define HOWL_RIG_DUCT_H_

#include <complex>
#include <vector>

namespace rig {

using Complex = std::complex<double>;

// What the duct is to be like: natural frequency and damping ratio of the first mode, the second's
// frequency over the first's, strengths in (units of p per unit of q) rad/s.
struct Modes {
  double omega_hz = 200.0;
  double xi = 0.1;
  double N = 1.0;
  double M = 0.2;
  double ratio = 3.0;
  double second_xi_factor = 1.0;  // the second mode's damping ratio over the first's
};

// N s / (s^2 + 2 xi w s + w^2) + the same of the second mode, at s.
Complex ModalResponse(const Modes& modes, Complex s);

struct Duct {
  double spacing_s = 0.0;            // d
  std::vector<double> reflection;    // R_k, k = 0, 1, ...; the first ones are zero
  std::vector<double> distribution;  // S_k

  Complex Response(Complex s) const;  // G(s)
};

// Throws std::runtime_error where no passive end gives these modes.
Duct DesignDuct(const Modes& modes, double spacing_s);

// Largest relative distance of the duct's response from the modes' between two frequencies.
double LargestMismatch(const Duct& duct, const Modes& modes, double low_hz, double high_hz);

}  // namespace rig

#endif  // HOWL_RIG_DUCT_H_
