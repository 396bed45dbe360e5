// Where the loop could cycle, and how far it is from doing so (the paper, (1a), (1b), figure 12).
//
//   phase crossing:  arg L(j 2 pi f) = 180 degrees (mod 360), with gain |Phi'(0) L|: where
//                    Nyquist's curve crosses the negative real axis
//   gain crossing:   |Phi'(0) L(j 2 pi f)| = 1
//
// None is missed. With N, M >= 0 the phase of L is pi + a - b - c - 2 pi f tau, where a, b, c are
// phases of quadratics with positive coefficients, each of which grows with f: this bounds the
// phase and its rate over any interval, and intervals are halved until each is free of crossings
// or is monotonic. Gain crossings are the roots of a polynomial of degree four in f^2.
//
// Frequencies in Hz, slope in (units of q) / (units of p / s), phases in degrees.
#ifndef HOWL_MODEL_LOOP_CROSSINGS_H_
#define HOWL_MODEL_LOOP_CROSSINGS_H_

#include <complex>
#include <vector>

#include "model/loop/loop.h"

namespace howl {

struct PhaseCrossing {
  double frequency_hz = 0.0;
  double gain = 0.0;                   // |Phi'(0) L|: (1b) holds above one
  double gain_margin_db = 0.0;         // -20 log10(gain)
  double phase_rate_deg_per_hz = 0.0;  // of L; negative where the phase falls through 180
  int turns = 0;                       // the loop's phase is 180 - 360 turns degrees, unwrapped
};

struct GainCrossing {
  double frequency_hz = 0.0;
  double phase_margin_deg = 0.0;  // in (-180, 180]: further lag that would make the phase 180
  double delay_margin_s = 0.0;    // further delay that would do so: in [0, 1 / frequency)
};

struct LoopMargins {
  double gain_margin_db = 0.0;    // of the crossing with the largest gain; infinite without one
  double phase_margin_deg = 0.0;  // smallest in magnitude; infinite without a gain crossing
  double delay_margin_s = 0.0;    // smallest; infinite without a gain crossing
  bool stable = false;            // by Nyquist's count up to frequency_max_hz
};

struct NyquistPoint {
  double frequency_hz = 0.0;
  std::complex<double> response;  // |Phi'(0)| L: the critical point is -1
};

// Phase of L(j 2 pi f) without jumps, in radians: pi at f = 0. Needs N, M >= 0.
double UnwrappedLoopPhase(const LoopParameters<double>& loop, double frequency_hz);

// All in (0, frequency_max_hz], in order.
std::vector<PhaseCrossing> PhaseCrossings(const LoopParameters<double>& loop, double flame_slope,
                                          double frequency_max_hz);
std::vector<GainCrossing> GainCrossings(const LoopParameters<double>& loop, double flame_slope,
                                        double frequency_max_hz);

LoopMargins Margins(const LoopParameters<double>& loop, double flame_slope,
                    double frequency_max_hz);

// Pairs of closed-loop poles in the right half-plane, by Nyquist: a crossing with gain above one
// counts +1 where the phase falls and -1 where it rises. Right when |Phi'(0)| (N + M) < 1 and no
// crossing beyond frequency_max_hz has a gain above one.
int UnstablePairs(const std::vector<PhaseCrossing>& crossings);

// Curve with steps of at most max_angle_deg as seen from the origin.
std::vector<NyquistPoint> NyquistCurve(const LoopParameters<double>& loop, double flame_slope,
                                       double frequency_max_hz, double max_angle_deg = 2.0);

}  // namespace howl

#endif  // HOWL_MODEL_LOOP_CROSSINGS_H_
