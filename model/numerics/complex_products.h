// Products a b and conj(a) b without the checks for infinities that those of std::complex contain.
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

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_COMPLEX_PRODUCTS_H_
