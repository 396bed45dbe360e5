#include "estimation/family/bounds/contract/second_mode_bound.h"

#include <algorithm>

namespace howl {

namespace {

struct Detunings {
  Interval first, second;  // y and y_r
};

Detunings DetuningsOf(const Interval& omega_hz, const Interval& harmonic_ratio,
                      const Interval& frequency_hz) {
  return {DetuningOf(frequency_hz, omega_hz), DetuningOf(frequency_hz / harmonic_ratio, omega_hz)};
}

// (xi^2 + y^2) / (xi^2 + y_r^2): rises with y^2, falls with y_r^2, and is monotonic in xi, so that
// its extremes over xi lie at the ends.
Interval ShapeOf(const Interval& xi, const Detunings& y) {
  const Interval a = square(y.first);
  const Interval b = square(y.second);
  const auto at = [](double damping, double above, double below) {
    const Interval u = square(Interval(damping));
    return Quotient(u + Interval(above), u + Interval(below));
  };
  const auto finite = [](double value) { return std::isfinite(value); };
  double hi = kUnbounded;
  if (finite(a.upper()) && finite(xi.upper())) {
    hi = std::max(at(xi.lower(), a.upper(), b.lower()).upper(),
                  at(xi.upper(), a.upper(), b.lower()).upper());
  }
  double lo = 0.0;
  if (finite(b.upper())) {
    lo = at(xi.lower(), a.lower(), b.upper()).lower();
    // Towards infinite damping the shape tends to one.
    lo = std::min(lo, finite(xi.upper()) ? at(xi.upper(), a.lower(), b.upper()).lower() : 1.0);
  }
  // Written so that a NaN, as of 0 / 0, bounds nothing.
  return {lo > 0.0 ? lo : 0.0, hi >= lo ? hi : Unbounded()};
}

// 1 / (2 omega xi + j (w - omega^2 / w)); rate = 2 pi.
Complex<Interval> UnitMode(const Interval& rate, const Interval& omega_hz, const Interval& xi,
                           const Interval& w) {
  const Interval omega = rate * omega_hz;
  const Complex<Interval> d{2.0 * omega * xi, w - square(omega) / w};
  const Interval size = square(d.re) + square(d.im);
  return {Quotient(d.re, size), -Quotient(d.im, size)};
}

double LargestMagnitude(const Complex<Interval>& z) {
  const double largest = sqrt(square(z.re) + square(z.im)).upper();
  return largest >= 0.0 ? largest : Unbounded();
}

}  // namespace

Interval SecondModeShareOf(const Interval& omega_hz, const Interval& xi, const Interval& relative,
                           const Interval& harmonic_ratio, const Interval& frequency_hz) {
  const Interval shape = ShapeOf(xi, DetuningsOf(omega_hz, harmonic_ratio, frequency_hz));
  return relative / harmonic_ratio * sqrt(shape);
}

bool ContractSecondModeShare(const ContractTarget& target, ExperimentBox& box) {
  if (!std::isfinite(target.second_mode_share_max)) return true;
  Interval& relative = box[kCellRelative];
  const Interval& xi = box[kCellXi];
  const Interval& r = target.harmonic_ratio;
  const Interval scale = Interval(target.second_mode_share_max) * r;
  Detunings y = DetuningsOf(box[kCellOmega], r, target.frequency_hz);
  const double least = sqrt(ShapeOf(xi, y)).lower();
  if (least > 0.0 && !NarrowUpper(relative, (scale / Interval(least)).upper())) return false;
  if (!(relative.lower() > 0.0)) return true;
  // xi^2 + y^2 <= (scale / relative)^2 (xi^2 + y_r^2), solved for y and for y_r.
  const Interval most = square(scale / Interval(relative.lower()));
  const double y_limit = (most * (square(xi) + square(y.second)) - square(xi)).upper();
  if (y_limit < 0.0) return false;
  if (std::isfinite(y_limit)) {
    const double reach = sqrt(Interval(y_limit)).upper();
    if (!Narrow(y.first, Interval(-reach, reach))) return false;
  }
  if (most.upper() > 0.0 && std::isfinite(xi.upper())) {
    const Interval left = (square(xi) + square(y.first)) / Interval(most.upper()) - square(xi);
    if (left.lower() > 0.0) {
      // |y_r| is at least this: one of the two sides may be out of reach.
      const double reach = sqrt(Interval(left.lower())).lower();
      if (y.second.lower() > -reach && !NarrowLower(y.second, reach)) return false;
      if (y.second.upper() < reach && !NarrowUpper(y.second, -reach)) return false;
    }
  }
  return Narrow(box[kCellOmega], OmegaOf(target.frequency_hz, y.first)) &&
         Narrow(box[kCellOmega], OmegaOf(target.frequency_hz / r, y.second));
}

bool ContractLineGain(const ContractTarget& target, ExperimentBox& box) {
  const Interval rate = target.w_rad_s / target.frequency_hz;
  Interval& n = box[kCellN];
  Interval& m = box[kCellM];
  const Interval& relative = box[kCellRelative];
  for (std::size_t k = 0; k < target.line_response_min.size(); ++k) {
    const Interval& least = target.line_response_min[k];
    const Interval w = rate * target.lines_hz[k];
    const Complex<Interval> first = UnitMode(rate, box[kCellOmega], box[kCellXi], w);
    const Complex<Interval> other =
        UnitMode(rate, target.harmonic_ratio * box[kCellOmega], box[kCellXi], w);
    // |N U_1 + M U_r| = N |U_1 + (M / N) U_r| <= N |U_1| + M |U_r|
    if (std::isfinite(relative.upper())) {
      const double size = LargestMagnitude(first + relative * other);
      if (size == 0.0) return false;
      if (std::isfinite(size) && !NarrowLower(n, (least / Interval(size)).lower())) return false;
    }
    const double first_size = LargestMagnitude(first);
    const double other_size = LargestMagnitude(other);
    if (!(other_size > 0.0) || !std::isfinite(other_size) || !std::isfinite(n.upper())) continue;
    const Interval rest = least - Interval(n.upper()) * Interval(first_size);
    if (rest.lower() > 0.0 && !NarrowLower(m, (rest / Interval(other_size)).lower())) return false;
  }
  return true;
}

}  // namespace howl
