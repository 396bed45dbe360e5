// Intervals with outward rounding (Boost.Interval), and the monotone functions that the
// contractors need. Rounding stays switched to upward while a RoundingGuard lives; interval
// arithmetic is valid only then, and other floating-point work should not be done under it.
//
// A source file that computes with intervals must be compiled with -frounding-math (as
// estimation/CMakeLists.txt does): otherwise the compiler moves operations across the switch.
//
// Elementary functions come from the C library, good to an ulp or two in any rounding mode; their
// results are widened by four.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_INTERVAL_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_INTERVAL_H_

#include <bit>
#include <boost/numeric/interval.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace howl {

// Boost.Interval switches the rounding mode twice for each root that it rounds downward, which took
// a fifth of the time of a contraction with two modes. The root rounded upward tells the same: it
// is exact where its square is x, however rounded, and else the number below it is the root rounded
// downward.
struct OutwardArithmetic : boost::numeric::interval_lib::rounded_arith_opp<double> {
  double sqrt_down(const double& x) {  // x > 0
    const double root = sqrt_up(x);
    if (mul_up(root, root) == x && mul_down(root, root) == x) return root;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(root) - 1);
  }
};

using GuardedInterval = boost::numeric::interval<
    double, boost::numeric::interval_lib::policies<
                boost::numeric::interval_lib::save_state<
                    boost::numeric::interval_lib::rounded_transc_std<double, OutwardArithmetic>>,
                boost::numeric::interval_lib::checking_base<double>>>;
using Interval = boost::numeric::interval_lib::unprotect<GuardedInterval>::type;

class RoundingGuard {
 private:
  GuardedInterval::traits_type::rounding rounding_;
};

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// The same as a value rather than a constant, for the two arms of a conditional.
inline double Unbounded() { return std::numeric_limits<double>::infinity(); }

// x becomes its intersection with `other`; false when that is empty. A NaN bound, as of 0 * inf,
// narrows nothing.
inline bool Narrow(Interval& x, const Interval& other) {
  const double lo = other.lower() > x.lower() ? other.lower() : x.lower();
  const double hi = other.upper() < x.upper() ? other.upper() : x.upper();
  if (!(lo <= hi)) return false;
  x.assign(lo, hi);
  return true;
}

inline bool NarrowLower(Interval& x, double lo) { return Narrow(x, Interval(lo, Unbounded())); }
inline bool NarrowUpper(Interval& x, double hi) { return Narrow(x, Interval(-Unbounded(), hi)); }

// {a / b : b != 0}; the whole line where b has zero inside.
inline Interval Quotient(const Interval& a, const Interval& b) {
  if (b.upper() < 0.0 || (b.upper() == 0.0 && b.lower() < 0.0)) return -Quotient(a, -b);
  if (b.lower() > 0.0) return a / b;
  if (b.lower() < 0.0 || b.upper() == 0.0) return Interval(-Unbounded(), Unbounded());
  // b = [0, b.upper]
  const Interval at_end = a / Interval(b.upper());
  return Interval(a.lower() >= 0.0 ? at_end.lower() : -Unbounded(),
                  a.upper() <= 0.0 ? at_end.upper() : Unbounded());
}

// Bounds of a value that is good to a few ulp.
inline double Below(double value) {
  return value - (std::abs(value) * 9e-16 + std::numeric_limits<double>::min());
}
inline double Above(double value) {
  return value + (std::abs(value) * 9e-16 + std::numeric_limits<double>::min());
}
inline Interval Widened(double lo, double hi) { return {Below(lo), Above(hi)}; }
inline Interval Widened(double value) { return Widened(value, value); }

// The part of x outside the domain has no value: the enclosure is of the rest.
inline Interval Logarithm(const Interval& x) {
  if (!(x.upper() > 0.0)) return Interval(-Unbounded(), Unbounded());
  return Interval(x.lower() > 0.0 ? Below(std::log(x.lower())) : -Unbounded(),
                  std::isfinite(x.upper()) ? Above(std::log(x.upper())) : Unbounded());
}
inline Interval Exponential(const Interval& x) {
  return Interval(std::isfinite(x.lower()) ? Below(std::exp(x.lower())) : 0.0,
                  std::isfinite(x.upper()) ? Above(std::exp(x.upper())) : Unbounded());
}
inline Interval Arctangent(const Interval& x) {
  return {Below(std::atan(x.lower())), Above(std::atan(x.upper()))};
}

// For x within (-pi / 2, pi / 2); unbounded where x reaches an end.
inline Interval Tangent(const Interval& x) {
  constexpr double kHalfPi = 1.5707963267948966;
  return Interval(x.lower() <= -kHalfPi ? -Unbounded() : Below(std::tan(x.lower())),
                  x.upper() >= kHalfPi ? Unbounded() : Above(std::tan(x.upper())));
}

// y = sinh(ln(f / omega)): falls with omega > 0.
inline Interval DetuningOf(const Interval& frequency_hz, const Interval& omega_hz) {
  const auto at = [&](double omega) {
    const Interval x(omega);
    return 0.5 * (frequency_hz / x - x / frequency_hz);
  };
  return Interval(std::isfinite(omega_hz.upper()) ? at(omega_hz.upper()).lower() : -Unbounded(),
                  omega_hz.lower() > 0.0 ? at(omega_hz.lower()).upper() : Unbounded());
}

// Its inverse, omega = f (sqrt(1 + y^2) - y).
inline Interval OmegaOf(const Interval& frequency_hz, const Interval& detuning) {
  const auto at = [&](double y) {
    const Interval x(y);
    const Interval root = sqrt(1.0 + x * x);
    return y > 0.0 ? frequency_hz / (root + x) : frequency_hz * (root - x);
  };
  return Interval(std::isfinite(detuning.upper()) ? at(detuning.upper()).lower() : 0.0,
                  std::isfinite(detuning.lower()) ? at(detuning.lower()).upper() : Unbounded());
}

inline double Width(const Interval& x) { return x.upper() - x.lower(); }

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_INTERVAL_H_
