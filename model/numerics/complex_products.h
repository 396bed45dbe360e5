// Products a b and conj(a) b, and 1 / a, without the checks for infinities that those of
// std::complex contain: for numbers whose squares are within the range of a double.
#ifndef HOWL_MODEL_NUMERICS_COMPLEX_PRODUCTS_H_
#define HOWL_MODEL_NUMERICS_COMPLEX_PRODUCTS_H_

#include <complex>

namespace howl {

inline std::complex<double> Times(std::complex<double> a, std::complex<double> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
inline std::complex<double> ConjugateTimes(std::complex<double> a, std::complex<double> b) {
  return {a.real() * b.real() + a.imag() * b.imag(), a.real() * b.imag() - a.imag() * b.real()};
}
inline std::complex<double> Reciprocal(std::complex<double> a) {
  const double scale = 1.0 / (a.real() * a.real() + a.imag() * a.imag());
  return {a.real() * scale, -a.imag() * scale};
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_COMPLEX_PRODUCTS_H_
