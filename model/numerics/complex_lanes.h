// Complex numbers in eight lanes of a vector, or in one: a loop over bins is written once for both,
// eight at a time and what is left. Each lane is computed as if alone. For functions that are
// cloned for each width of vectors (vector_clones.h); other sources cannot include this header, as
// what a function hands over in vectors differs from width to width.
#ifndef HOWL_MODEL_NUMERICS_COMPLEX_LANES_H_
#define HOWL_MODEL_NUMERICS_COMPLEX_LANES_H_

#include <complex>
#include <cstring>

#include "model/numerics/vector_clones.h"

namespace howl {

inline constexpr int kLanes = 8;
typedef double EightLanes __attribute__((vector_size(kLanes * sizeof(double))));

// Numbers of memory, which need not be aligned, in the lanes of V.
template <typename V>
struct Lanes {
  HOWL_IN_CLONES static V Load(const double* from) {
    V out;
    std::memcpy(&out, from, sizeof(V));
    return out;
  }
  HOWL_IN_CLONES static void Store(const V& value, double* to) {
    std::memcpy(to, &value, sizeof(V));
  }
};

template <typename V>
struct ComplexLanes {
  V re;
  V im;

  HOWL_IN_CLONES static ComplexLanes Load(const std::complex<double>* from);
};

template <>
HOWL_IN_CLONES ComplexLanes<double> ComplexLanes<double>::Load(const std::complex<double>* from) {
  return {from->real(), from->imag()};
}

template <>
HOWL_IN_CLONES ComplexLanes<EightLanes> ComplexLanes<EightLanes>::Load(
    const std::complex<double>* from) {
  const auto* numbers = reinterpret_cast<const double*>(from);
  const EightLanes low = Lanes<EightLanes>::Load(numbers);
  const EightLanes high = Lanes<EightLanes>::Load(numbers + kLanes);
  return {__builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14),
          __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15)};
}

template <typename V>
HOWL_IN_CLONES ComplexLanes<V> operator+(const ComplexLanes<V>& a, const ComplexLanes<V>& b) {
  return {a.re + b.re, a.im + b.im};
}

template <typename V>
HOWL_IN_CLONES ComplexLanes<V> operator-(const ComplexLanes<V>& a, const ComplexLanes<V>& b) {
  return {a.re - b.re, a.im - b.im};
}

template <typename V>
HOWL_IN_CLONES ComplexLanes<V> operator*(const ComplexLanes<V>& a, const ComplexLanes<V>& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

template <typename V>
HOWL_IN_CLONES ComplexLanes<V> operator*(const V& a, const ComplexLanes<V>& b) {
  return {a * b.re, a * b.im};
}

// conj(a) b
template <typename V>
HOWL_IN_CLONES ComplexLanes<V> ConjugateTimes(const ComplexLanes<V>& a, const ComplexLanes<V>& b) {
  return {a.re * b.re + a.im * b.im, a.re * b.im - a.im * b.re};
}

template <typename V>
HOWL_IN_CLONES V SquaredMagnitude(const ComplexLanes<V>& a) {
  return a.re * a.re + a.im * a.im;
}

template <typename V>
HOWL_IN_CLONES ComplexLanes<V> Conjugate(const ComplexLanes<V>& a) {
  return {a.re, -a.im};
}

template <typename V>
HOWL_IN_CLONES ComplexLanes<V> Reciprocal(const ComplexLanes<V>& a) {
  const V scale = 1.0 / SquaredMagnitude(a);
  return {a.re * scale, -a.im * scale};
}

HOWL_IN_CLONES void Store(const ComplexLanes<double>& a, std::complex<double>* to) {
  *to = {a.re, a.im};
}

HOWL_IN_CLONES void Store(const ComplexLanes<EightLanes>& a, std::complex<double>* to) {
  auto* numbers = reinterpret_cast<double*>(to);
  Lanes<EightLanes>::Store(__builtin_shufflevector(a.re, a.im, 0, 8, 1, 9, 2, 10, 3, 11), numbers);
  Lanes<EightLanes>::Store(__builtin_shufflevector(a.re, a.im, 4, 12, 5, 13, 6, 14, 7, 15),
                           numbers + kLanes);
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_COMPLEX_LANES_H_
