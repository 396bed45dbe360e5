// Complex arithmetic for EvaluateFormula (formula.h): principal branches of sqrt, log and ^; a
// whole power up to 64 is a product, without a branch.
#ifndef HOWL_MODEL_NUMERICS_FORMULA_COMPLEX_H_
#define HOWL_MODEL_NUMERICS_FORMULA_COMPLEX_H_

#include <cmath>
#include <complex>

namespace howl {

// Real operands stay real: an infinite null value then gives zero or one, never NaN.
struct FormulaComplex {
  static constexpr double kLargestWholePower = 64.0;

  static bool IsReal(std::complex<double> a) { return a.imag() == 0.0; }
  static std::complex<double> Scaled(double a, std::complex<double> b) {
    return {a * b.real(), IsReal(b) ? 0.0 : a * b.imag()};
  }
  static std::complex<double> Multiply(std::complex<double> a, std::complex<double> b) {
    if (IsReal(a)) return Scaled(a.real(), b);
    if (IsReal(b)) return Scaled(b.real(), a);
    return a * b;
  }
  static std::complex<double> Divide(std::complex<double> a, std::complex<double> b) {
    if (IsReal(b)) return {a.real() / b.real(), IsReal(a) ? 0.0 : a.imag() / b.real()};
    return a / b;
  }
  static std::complex<double> Power(std::complex<double> a, std::complex<double> b) {
    if (IsReal(b) && b.real() == std::round(b.real()) && std::abs(b.real()) <= kLargestWholePower) {
      std::complex<double> product = 1.0;
      for (int i = 0; i < std::abs(static_cast<int>(b.real())); ++i) product = Multiply(product, a);
      return b.real() < 0.0 ? Divide(1.0, product) : product;
    }
    if (IsReal(a) && IsReal(b) && a.real() >= 0.0) return std::pow(a.real(), b.real());
    return std::pow(a, b);
  }
  static std::complex<double> Root(std::complex<double> a) {
    return IsReal(a) && a.real() >= 0.0 ? std::complex<double>(std::sqrt(a.real())) : std::sqrt(a);
  }
  static std::complex<double> Exponential(std::complex<double> a) {
    return IsReal(a) ? std::complex<double>(std::exp(a.real())) : std::exp(a);
  }
  static std::complex<double> Logarithm(std::complex<double> a) {
    return IsReal(a) && a.real() >= 0.0 ? std::complex<double>(std::log(a.real())) : std::log(a);
  }
  static std::complex<double> Sine(std::complex<double> a) {
    return IsReal(a) ? std::complex<double>(std::sin(a.real())) : std::sin(a);
  }
  static std::complex<double> Cosine(std::complex<double> a) {
    return IsReal(a) ? std::complex<double>(std::cos(a.real())) : std::cos(a);
  }
  static std::complex<double> Absolute(std::complex<double> a) { return std::abs(a); }
};

}  // namespace howl

#endif  // HOWL_MODEL_NUMERICS_FORMULA_COMPLEX_H_
