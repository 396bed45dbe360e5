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

// sqrt(1 + 2 w)
C RootOf(C w) { return std::sqrt(1.0 + 2.0 * w); }

C Exponential(C x) { return std::polar(std::exp(x.real()), x.imag()); }

}  // namespace

C FlamePath::At(C s) const {
  const C delayed = tau * s;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal:
      return Exponential(-2.0 * Times(delayed, Reciprocal(1.0 + RootOf(rho * rho * delayed))));
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
      const C root = RootOf(square * delayed);
      const C half = Times(delayed, Reciprocal(1.0 + root));
      const C late = Times(delayed, Reciprocal(root));
      return {Exponential(-2.0 * half), -late,
              4.0 * square * Times(Times(late, half), Reciprocal(1.0 + root))};
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

C FlamePath::ByLogTau(C s) const { return WithSlopes(s).by_log_tau; }

C FlamePath::ByLogRho(C s) const { return WithSlopes(s).by_log_rho; }

C FlamePath::Fall(C s) const {
  const double square = rho * rho;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal:
      return tau * Reciprocal(RootOf(square * tau * s) + square);
    case DelaySpread::kGamma:
      return tau * (1.0 - square) * Reciprocal(1.0 + square * tau * s);
  }
  return tau;
}

C FlamePath::FallByLogTau(C s) const {
  const C wide = rho * rho * tau * s;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal: {
      const C root = RootOf(wide);
      const C at = Reciprocal(root + rho * rho);
      return tau * Times(at, 1.0 - Times(wide, Times(at, Reciprocal(root))));
    }
    case DelaySpread::kGamma:
      return tau * (1.0 - rho * rho) / std::pow(1.0 + wide, 2);
  }
  return tau;
}

C FlamePath::FallByLogRho(C s) const {
  const double square = rho * rho;
  const C wide = square * tau * s;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal: {
      const C root = RootOf(wide);
      return -2.0 * tau * (wide / root + square) / std::pow(root + square, 2);
    }
    case DelaySpread::kGamma:
      return -2.0 * tau * (square + wide) / std::pow(1.0 + wide, 2);
  }
  return 0.0;
}

}  // namespace howl
