#include "estimation/record_fit/flame_path.h"

#include <cmath>

namespace howl {

using C = std::complex<double>;

C FlamePath::At(C s) const {
  const C delayed = tau * s;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal:
      return std::exp(-delayed + 0.5 * rho * rho * delayed * delayed);
    case DelaySpread::kGamma:
      return std::exp(-std::log(1.0 + rho * rho * delayed) / (rho * rho));
  }
  return std::polar(std::exp(-delayed.real()), -delayed.imag());
}

Eigen::VectorXcd FlamePath::At(const Eigen::VectorXcd& s) const {
  return s.unaryExpr([this](C each) { return At(each); });
}

// All three depend on tau s alone.
C FlamePath::ByLogTau(C s) const { return s * BySlope(s); }

C FlamePath::ByLogRho(C s) const {
  const C delayed = tau * s;
  switch (spread) {
    case DelaySpread::kNone:
      break;
    case DelaySpread::kNormal:
      return rho * rho * delayed * delayed;
    case DelaySpread::kGamma:
      return 2.0 * (std::log(1.0 + rho * rho * delayed) / (rho * rho) -
                    delayed / (1.0 + rho * rho * delayed));
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
      return -tau / (1.0 + rho * rho * tau * s);
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
