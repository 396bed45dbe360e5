// How far off k parameters are together, said in standard deviations of one number. For k numbers
// with normal errors d^2 = e^T C^-1 e is chi-square with k degrees of freedom, and reaches a given
// value more often the larger k is: beyond 4 lies 1 of 16 000 records where one number is asked,
// and 1 of 330 where four are. The deviation z is as improbable for one number as d for k:
//
//   P(chi2_1 > z^2) = P(chi2_k > d^2).
//
// With P(chi2_k > d^2) = exp(-d^2 / 2) h_k(d), the incomplete gamma function's recurrence
// (Abramowitz and Stegun 26.4.8) gives
//
//   h_1(d) = erfcx(d / sqrt 2),   h_2(d) = 1,
//   h_{k+2}(d) = h_k(d) + (d^2/2)^{k/2} / Gamma(k/2 + 1),
//
// so that no probability underflows, however far the distance.
#ifndef HOWL_ESTIMATION_ANALYSIS_TRANSFER_JOINT_DEVIATION_H_
#define HOWL_ESTIMATION_ANALYSIS_TRANSFER_JOINT_DEVIATION_H_

namespace howl {

// z of d; k >= 1, d >= 0. Increases with d, z <= d.
double DeviationOfDistance(double distance, int count);

// d of z: its inverse.
double DistanceOfDeviation(double deviation, int count);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_TRANSFER_JOINT_DEVIATION_H_
