// The determinant of the loop about its cycle, which the likelihood of a closed loop needs
// (whittle.h): the Jacobian of the change from the signals (p, q) to what drives them.
//
// Small signals see the flame's slope at the cycle's present value, which is periodic. With theta
// the cycle's phase and U = R e^(-tau s) V(s) the loop but for the slope,
//
//   Phi'(v(t)) = phi_0 + 2 Re(phi_2 e^(2 j theta)) + ...
//   D(f) = (1 - phi_0 U(f)) (1 - phi_0 U(f')*) - |phi_2|^2 U(f) U(f')*,     f' = 2 f_cycle - f
//
// is the determinant of the two frequencies that phi_2 couples, the central block of Hill's. At the
// cycle's own frequency it vanishes, as the cycle's phase is free: phi_0 alone makes a loop that is
// stable there, and a fit makes up for it by a damping that is too large. Above twice the cycle's
// frequency, where the coupling is with frequencies at which little happens, D is that of phi_0
// alone.
//
//   ln |det| = w sum_f ln |D(f)|   (f' < 0: w sum_f 2 ln |1 - phi_0 U(f)|)
#ifndef HOWL_ESTIMATION_RECORD_FIT_RETURN_DIFFERENCE_H_
#define HOWL_ESTIMATION_RECORD_FIT_RETURN_DIFFERENCE_H_

#include <Eigen/Core>
#include <complex>

#include "estimation/record_fit/loop_point.h"

namespace howl {

// U at s.
std::complex<double> OpenLoop(const RecordSpectra& record, const LoopPoint& point,
                              std::complex<double> s);

double LogDeterminant(const RecordSpectra& record, const LoopPoint& point);

// By the parameters that loop_point.h lists, of which the noise's have none.
Eigen::VectorXd LogDeterminantGradient(const RecordSpectra& record, const PointStructure& structure,
                                       const LoopPoint& point);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_RETURN_DIFFERENCE_H_
