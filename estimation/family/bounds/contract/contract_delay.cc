// The loop's phase, at the cycle and at observed lines (contract.h).
#include <algorithm>
#include <cmath>

#include "estimation/family/bounds/contract/contract.h"
#include "model/numerics/complex.h"
#include "model/numerics/constants.h"

namespace howl {

bool ContractDelay(const ContractTarget& target, ExperimentBox& box) {
  Interval phase = -Arctangent(box[kCellTangent]);
  Interval turned = target.w_rad_s * box[kCellTau];
  if (!Narrow(turned, target.turns + phase - box[kCellLoopPhase]) ||
      !Narrow(box[kCellTau], turned / target.w_rad_s) ||
      !Narrow(phase, turned - target.turns + box[kCellLoopPhase]) ||
      !Narrow(box[kCellLoopPhase], target.turns + phase - turned)) {
    return false;
  }
  return Narrow(box[kCellTangent], Tangent(-phase));
}

bool ContractLines(const ContractTarget& target, ExperimentBox& box) {
  if (!target.has_line_error) return true;
  for (const Interval& line : target.lines_hz) {
    const Interval w = target.w_rad_s / target.frequency_hz * line;
    const Interval rate = target.w_rad_s / target.frequency_hz;
    // The direction of G at the line, of U_1 + (M / N) U_r; a positive factor changes nothing.
    const auto mode = [&](const Interval& omega_hz) {
      const Interval omega = rate * omega_hz;
      const Complex<Interval> d{2.0 * omega * box[kCellXi], w - square(omega) / w};
      const Interval size = square(d.re) + square(d.im);
      return Complex<Interval>{Quotient(d.re, size), -Quotient(d.im, size)};
    };
    const Complex<Interval> first = mode(box[kCellOmega]);
    const Complex<Interval> other = mode(target.harmonic_ratio * box[kCellOmega]);
    const Interval& m = box[kCellRelative];
    Interval re = first.re;
    Interval im = first.im;
    if (m.upper() < kUnbounded) {
      re = first.re + m * other.re;
      im = first.im + m * other.im;
    } else {
      continue;
    }
    // Both modes are dissipative: re > 0.
    if (!NarrowLower(re, 0.0)) return false;
    if (!(re.lower() > 0.0) || !std::isfinite(re.upper())) continue;
    const Interval angle = Arctangent(Quotient(im, re));
    // w tau = angle - pi / 2 - error + 2 pi k
    const Interval turned = angle - Widened(kPi / 2) - target.line_error_rad;
    const Interval full_turn = Widened(2 * kPi);
    const Interval k_range = (w * box[kCellTau] - turned) / full_turn;
    if (Width(k_range) > 8.0 || !std::isfinite(k_range.upper())) continue;
    double lo = kUnbounded;
    double hi = -kUnbounded;
    for (double k = std::ceil(k_range.lower()); k <= k_range.upper(); k += 1.0) {
      Interval tau = box[kCellTau];
      if (!Narrow(tau, (turned + full_turn * k) / w)) continue;
      lo = std::min(lo, tau.lower());
      hi = std::max(hi, tau.upper());
    }
    if (!(lo <= hi) || !Narrow(box[kCellTau], Interval(lo, hi))) return false;
  }
  return true;
}

}  // namespace howl
