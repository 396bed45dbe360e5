// tanh(x) = e / (e + 2), e = exp(2 |x|) - 1, without branches or tables, so that a compiler turns a
// loop of it into vector code. At most 3 units in the last place from the true value over all
// finite x; odd; exactly +-1 beyond |x| = 20; NaN stays NaN.
//
// 2 |x| = k ln 2 + r, |r| <= ln(2) / 2, and e = 2^k (exp(r) - 1) + (2^k - 1), where exp(r) - 1 is
// its Taylor series to r^13 (remainder below 2e-17 of r). Additions, products and one quotient
// only: the same bits on every machine, provided that products and sums are not fused.
#ifndef HOWL_MODEL_NUMERICS_FAST_TANH_H_
#define HOWL_MODEL_NUMERICS_FAST_TANH_H_

#include <bit>
#include <cmath>
#include <cstdint>

namespace howl {

[[gnu::always_inline]] inline double FastTanh(double x) {
  constexpr double kLog2E = 1.4426950408889634;
  constexpr double kLn2High = 0x1.62e42fee00000p-1;  // last 33 bits zero: k * high is exact
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  constexpr double kRound = 0x1.8p52;  // adding it rounds to an integer, left in the low bits

  double y = 2.0 * std::fabs(x);
  y = y > 40.0 ? 40.0 : y;
  const double shifted = y * kLog2E + kRound;
  const double k = shifted - kRound;
  const double r = (y - k * kLn2High) - k * kLn2Low;
  const double power =
      std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) << 52) + 0x3ff0000000000000u);

  double s = 1.0 / 6227020800.0;
  s = s * r + 1.0 / 479001600.0;
  s = s * r + 1.0 / 39916800.0;
  s = s * r + 1.0 / 3628800.0;
  s = s * r + 1.0 / 362880.0;
  s = s * r + 1.0 / 40320.0;
  s = s * r + 1.0 / 5040.0;
  s = s * r + 1.0 / 720.0;
  s = s * r + 1.0 / 120.0;
  s = s * r + 1.0 / 24.0;
  s = s * r + 1.0 / 6.0;
  s = s * r + 0.5;
  const double small = r + r * r * s;
  const double e = power * small + (power - 1.0);
  return std::copysign(e / (e + 2.0), x);
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_FAST_TANH_H_
