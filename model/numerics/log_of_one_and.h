// ln(1 + w) of a complex w by real functions, to rounding where w is small. The library's logarithm
// of a complex number near the unit circle sorts the parts of its square, which takes longer than
// the logarithm itself.
#ifndef HOWL_MODEL_NUMERICS_LOG_OF_ONE_AND_H_
#define HOWL_MODEL_NUMERICS_LOG_OF_ONE_AND_H_

#include <cmath>
#include <complex>

namespace howl {

inline std::complex<double> LogOfOneAnd(std::complex<double> w) {
  const double square_less_one = 2.0 * w.real() + std::norm(w);
  const double log_square =
      square_less_one > -0.5 ? std::log1p(square_less_one) : std::log(std::norm(1.0 + w));
  return {0.5 * log_square, std::atan2(w.imag(), 1.0 + w.real())};
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_LOG_OF_ONE_AND_H_
