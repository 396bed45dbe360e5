// The dilogarithm within the unit circle, by Bernoulli's numbers B_n in u = -ln(1 - z) (Lewin
// 1981):
//
//   Li2(z) = sum over n >= 1 of z^n / n^2 = sum over n >= 0 of B_n u^(n + 1) / (n + 1)!,   B_1 =
//   -1/2
//
// To 1e-11 where |u| < 1.5, and to 1e-6 where |u| < 3, that is but near z = 1.
#ifndef HOWL_MODEL_NUMERICS_DILOGARITHM_H_
#define HOWL_MODEL_NUMERICS_DILOGARITHM_H_

#include <complex>

namespace howl {

std::complex<double> Dilogarithm(std::complex<double> z);

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_DILOGARITHM_H_
