#include "estimation/record_fit/loop/flame_path.h"

#include <cmath>

#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// ln(1 + w), to rounding where w is small.
C LogOfOneAnd(C w) {
  return {0.5 * std::log1p(2.0 * w.real() + std::norm(w)), std::atan2(w.imag(), 1.0 + w.real())};
}

C Exponential(C x) { return std::polar(std::exp(x.real()), x.imag()); }

}  // namespace

C FlamePath::At(C s) const {
  const C delayed = tau * s;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal:
      return Exponential(-delayed + 0.5 * rho * rho * Times(delayed, delayed));
    case DelaySpread::kGamma:
      return Exponential(-LogOfOneAnd(rho * rho * delayed) / (rho * rho));
  }
  return Exponential(-delayed);
}

PathSlopes FlamePath::WithSlopes(C s) const {
  const C delayed = tau * s;
  const double square = rho * rho;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal: {
      const C wide = square * Times(delayed, delayed);
      return {Exponential(-delayed + 0.5 * wide), -delayed + wide, wide};
    }
    case DelaySpread::kGamma: {
      const C mean = LogOfOneAnd(square * delayed) / square;
      const C late = Times(delayed, Reciprocal(1.0 + square * delayed));
      return {Exponential(-mean), -late, 2.0 * (mean - late)};
    }
  }
  return {Exponential(-delayed), -delayed, 0.0};
}

Eigen::VectorXcd FlamePath::At(const Eigen::VectorXcd& s) const {
  return s.unaryExpr([this](C each) { return At(each); });
}

// All three depend on tau s alone.
C FlamePath::ByLogTau(C s) const { return Times(s, BySlope(s)); }

C FlamePath::ByLogRho(C s) const {
  const C delayed = tau * s;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal:
      return rho * rho * Times(delayed, delayed);
    case DelaySpread::kGamma:
      return 2.0 * (LogOfOneAnd(rho * rho * delayed) / (rho * rho) -
                    Times(delayed, Reciprocal(1.0 + rho * rho * delayed)));
  }
  return 0.0;
}

C FlamePath::BySlope(C s) const {
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal:
      return -tau + rho * rho * tau * tau * s;
    case DelaySpread::kGamma:
      return -tau * Reciprocal(1.0 + rho * rho * tau * s);
  }
  return -tau;
}

C FlamePath::BySlopeAndLogTau(C s) const {
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal:
      return -tau + 2.0 * rho * rho * tau * tau * s;
    case DelaySpread::kGamma:
      return -tau / std::pow(1.0 + rho * rho * tau * s, 2);
  }
  return -tau;
}

C FlamePath::BySlopeAndLogRho(C s) const {
  const C wide = rho * rho * tau * s;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal:
      return 2.0 * tau * wide;
    case DelaySpread::kGamma:
      return 2.0 * tau * wide / std::pow(1.0 + wide, 2);
  }
  return 0.0;
}

}  // namespace howl
