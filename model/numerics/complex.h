// Complex numbers over any scalar: double, ceres::Jet, or an interval.
//
// std::complex is specified for float, double and long double alone; with another scalar its
// behaviour is unspecified, and its division and abs() call functions that intervals lack.
#ifndef HOWL_MODEL_NUMERICS_COMPLEX_H_
#define HOWL_MODEL_NUMERICS_COMPLEX_H_

#include <cmath>

namespace howl {

template <typename T>
struct Complex {
  T re;
  T im;
};

template <typename T>
Complex<T> operator+(const Complex<T>& a, const Complex<T>& b) {
  return {a.re + b.re, a.im + b.im};
}

template <typename T>
Complex<T> operator-(const Complex<T>& a, const Complex<T>& b) {
  return {a.re - b.re, a.im - b.im};
}

template <typename T>
Complex<T> operator*(const Complex<T>& a, const Complex<T>& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

template <typename T>
Complex<T> operator*(const T& a, const Complex<T>& b) {
  return {a * b.re, a * b.im};
}

template <typename T>
T SquaredMagnitude(const Complex<T>& a) {
  return a.re * a.re + a.im * a.im;
}

template <typename T>
T Magnitude(const Complex<T>& a) {
  using std::sqrt;
  return sqrt(SquaredMagnitude(a));
}

// Angle in (-pi, pi]. To compare a phase with a measured one, rotate first and take the angle of
// the product: angles never subtract.
template <typename T>
T Angle(const Complex<T>& a) {
  using std::atan2;
  return atan2(a.im, a.re);
}

template <typename T>
Complex<T> operator/(const Complex<T>& a, const Complex<T>& b) {
  const T scale = T(1.0) / SquaredMagnitude(b);
  return {(a.re * b.re + a.im * b.im) * scale, (a.im * b.re - a.re * b.im) * scale};
}

// e^(j angle)
template <typename T>
Complex<T> UnitPhasor(const T& angle_rad) {
  using std::cos;
  using std::sin;
  return {cos(angle_rad), sin(angle_rad)};
}

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_COMPLEX_H_
