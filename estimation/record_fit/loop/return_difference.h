// The Jacobian of the change from a record's signals to its residuals, which the likelihood of a
// closed loop needs (whittle.h).
//
// E_A(t) and E_B(t) follow from p and q up to t, each signal standing in its own residual with
// weight one: over all frequencies the Jacobian is one, whatever the loop does, linear or not,
// decaying, growing or in a cycle. Of a loop that decays Bode's integral says the same,
//
//   D = 1 - phi_0 U,   U = R D_tau(s) V(s),   sum over all f of ln |D(f)| = 0,
//
// D_tau being the path of flame_path.h and phi_0 the flame's mean slope. Where the cuts err at the
// cycle's lines (loop_point.h) the residuals are of U times the lines' factors, and so is D in the
// band: large errors reach far beside their lines, and nats that they do not earn would be the
// reward of a loop that no residual shows. Slow changes take off F what small signals near the
// cycle meet of them. The likelihood has the bins of a band alone, and of those the Jacobian is
// what the others leave:
//
//   ln |det| = -w sum over f beyond the band of 2 ln |D(f)|
//
// The sum of 2 w ln |D| over the band itself is the same for a loop that decays, but not for one
// that grows, where Bode's integral is 2 pi times the sum of its growth rates: it would be a reward
// for growing. In a cycle phi_0 alone makes a loop that grows, as a mean slope is steeper than the
// describing function is. What the others leave is right there too, but known from the model alone,
// and only where no mode is far above the band. Each of the two is too large where it is wrong: the
// smaller one is taken, smoothly, as -ln(e^-a + e^-b) + ln 2.
//
// The sum goes over an octave above the band by intervals, D being straight in each. Beyond, from
// omega_2 on, U is D_tau times a constant K / D_tau, which there is if dp/dt drives the flame, and
// what falls off as 1 / omega^m:
//
//   integral of ln |D| = - Re [ Li2(K) / j l + (Li2(U) - Li2(K)) / (m / omega_2 + j l) ]
//
// at omega_2, with Li2 the dilogarithm and l the value of D_tau over its integral from there on
// (flame_path.h): tau where delays are not spread. Of a loop that is impossible (possible_loop.h)
// ln |det| is -infinity.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_RETURN_DIFFERENCE_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_RETURN_DIFFERENCE_H_

#include <Eigen/Core>
#include <complex>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/whittle/whittle_weights.h"

namespace howl {

// U at s.
std::complex<double> OpenLoop(const RecordSpectra& record, const LoopPoint& point,
                              std::complex<double> s);

double LogDeterminant(const RecordSpectra& record, const LoopPoint& point);
// The same where R and F of the record's bins are known already.
double LogDeterminant(const RecordSpectra& record, const LoopPoint& point, const LoopResiduals& at);
// Adds to the bins' weights what they have in the slope of ln |det|, given the value beside the
// band. Returns the weight of the latter's slope.
double AddBandWeights(const RecordSpectra& record, const LoopResiduals& at, double beside,
                      WhittleWeights* weights);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_RETURN_DIFFERENCE_H_
