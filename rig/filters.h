// Small linear filters on a grid.
#ifndef HOWL_RIG_FILTERS_H_
#define HOWL_RIG_FILTERS_H_

#include <cmath>
#include <complex>
#include <numbers>

namespace rig {

// 1 / (1 + s / w), exact for input that is linear between samples. An infinite frequency: none.
class Lag {
 public:
  Lag(double corner_hz, double step_s) {
    const double x = 2.0 * std::numbers::pi * corner_hz * step_s;
    if (!std::isfinite(x)) return;
    keep_ = std::exp(-x);
    slope_ = 1.0 - (1.0 - keep_) / x;
  }
  double Next(double u) {
    y_ = keep_ * y_ + (1.0 - keep_) * before_ + slope_ * (u - before_);
    before_ = u;
    return y_;
  }

 private:
  double keep_ = 0.0;
  double slope_ = 1.0;
  double y_ = 0.0;
  double before_ = 0.0;
};

// c s / (s^2 + 2 zeta w s + w^2), exact for input that is linear between samples.
class SideBranch {
 public:
  SideBranch(double frequency_hz, double zeta, double c, double step_s) {
    using C = std::complex<double>;
    const double w = 2.0 * std::numbers::pi * frequency_hz;
    const C pole = w * C(-zeta, std::sqrt(1.0 - zeta * zeta));
    turn_ = std::exp(pole * step_s);
    hold_ = (turn_ - 1.0) / pole;
    ramp_ = (turn_ - 1.0 - pole * step_s) / (pole * pole * step_s);
    residue_ = c * pole / (pole - std::conj(pole));
  }
  double Next(double u) {
    z_ = turn_ * z_ + hold_ * before_ + ramp_ * (u - before_);
    before_ = u;
    return 2.0 * (residue_ * z_).real();
  }

 private:
  std::complex<double> turn_;
  std::complex<double> hold_;
  std::complex<double> ramp_;
  std::complex<double> residue_;
  std::complex<double> z_ = 0.0;
  double before_ = 0.0;
};

// 2 zeta w s / (s^2 + 2 zeta w s + w^2): one at w.
class Resonance {
 public:
  Resonance(double frequency_hz, double zeta, double step_s)
      : branch_(frequency_hz, zeta, 4.0 * std::numbers::pi * zeta * frequency_hz, step_s) {}
  double Next(double u) { return branch_.Next(u); }

 private:
  SideBranch branch_;
};

// (b0 w^2 + b1 w s + b2 s^2) / (w^2 + 2 zeta w s + s^2) by the trapezoidal rule, exact at w.
class SecondOrder {
 public:
  SecondOrder(double frequency_hz, double zeta, double b0, double b1, double b2, double step_s) {
    const double k = std::tan(std::numbers::pi * frequency_hz * step_s);
    const double norm = 1.0 / (1.0 + 2.0 * zeta * k + k * k);
    n0_ = (b2 + b1 * k + b0 * k * k) * norm;
    n1_ = 2.0 * (b0 * k * k - b2) * norm;
    n2_ = (b2 - b1 * k + b0 * k * k) * norm;
    d1_ = 2.0 * (k * k - 1.0) * norm;
    d2_ = (1.0 - 2.0 * zeta * k + k * k) * norm;
  }
  double Next(double u) {
    const double y = n0_ * u + z1_;
    z1_ = n1_ * u - d1_ * y + z2_;
    z2_ = n2_ * u - d2_ * y;
    return y;
  }

 private:
  double n0_ = 1.0;
  double n1_ = 0.0;
  double n2_ = 0.0;
  double d1_ = 0.0;
  double d2_ = 0.0;
  double z1_ = 0.0;
  double z2_ = 0.0;
};

}  // namespace rig

#endif  // HOWL_RIG_FILTERS_H_
