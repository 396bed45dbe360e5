// Poles of the loop closed by its linearised flame: the roots of the characteristic equation
//
//   1 = k L(s) = k s G(s) e^(-tau s),   k = Phi'(0)
//
// First Newton on it, to rounding, from where the loop's phase lets it oscillate on the imaginary
// axis, and from where the poles tend to as k vanishes and as it grows without end. Then a count by
// the argument principle over the rectangle growth_min <= Re s <= bound, |Im s| <= frequency_max,
// where `bound` exceeds the real part of every pole: |k| sup|s G| e^(-tau bound) < 1. If the count
// and the list differ, Newton starts from the eigenvalues of the infinitesimal generator of the
// delay system, discretised at Chebyshev points (Breda, Maset & Vermiglio 2005), ever finer: with x
// the modes' states and w = p' over the past tau seconds, x' = A x + B k w(-tau),
// dw/dt = dw/dtheta, w(0) = C x + (N + M) k w(-tau). They cost fifty times as much.
//
// Growth rates in 1/s, frequencies in Hz. What is searched is a share of the first mode's natural
// frequency w = 2 pi omega, so that the same loop run slower or faster has the same poles for the
// same work.
#ifndef HOWL_MODEL_LOOP_POLES_H_
#define HOWL_MODEL_LOOP_POLES_H_

#include <optional>
#include <vector>

#include "model/loop/loop.h"

namespace howl {

struct Pole {
  double growth_rate = 0.0;   // Re s
  double frequency_hz = 0.0;  // Im s / (2 pi) >= 0: complex poles stand for their pair
};

struct PoleOptions {
  double growth_min = -0.15;    // of w; lower rates are not looked for
  double frequency_max = 10.0;  // of omega: three times the paper's second mode and more
};

struct PoleSet {
  std::vector<Pole> poles;  // rightmost first
  int counted = 0;          // by the argument principle; a pair counts once
  bool complete = false;    // the list has as many as were counted
};

// flame_slope is not zero.
PoleSet ClosedLoopPoles(const LoopParameters<double>& loop, double flame_slope,
                        const PoleOptions& options = {});

// The rightmost pole up to frequency_max, in units of omega; the search widens until there is one,
// and gives nothing where there is none down to growth rates of a thousand w. With a slope of zero
// the slowest mode's.
std::optional<Pole> RightmostPole(const LoopParameters<double>& loop, double flame_slope,
                                  double frequency_max = PoleOptions().frequency_max);

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_POLES_H_
