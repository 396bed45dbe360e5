#include "estimation/family/problem/member_chart.h"

#include <algorithm>
#include <cmath>

namespace howl {
namespace {

constexpr double kXiCap = 10.0;  // stands for "no upper limit"
// Below it, omega is so close to f that the phase of G loses the digits that the test needs.
constexpr double kTinyXi = 1e-5;

}  // namespace

MemberChart::MemberChart(const FamilyProblem& problem, double margin)
    : targets(MakeTargets(problem, margin)),
      two_modes(problem.model.modes == 2),
      relative(problem.model.second_mode_relative),
      second_kind(relative ? ParameterKind::kMOverN : ParameterKind::kM),
      shared_omega(problem.IsShared(ParameterKind::kOmega)),
      shared_xi(problem.IsShared(ParameterKind::kXi)),
      shared_N(problem.IsShared(ParameterKind::kN)),
      shared_second(two_modes && problem.IsShared(second_kind)),
      shared_tau(problem.IsShared(ParameterKind::kTau)),
      ratio(problem.model.harmonic_ratio),
      delay_periods(problem.domain.delay_periods),
      xi(problem.RangeOf(ParameterKind::kXi)) {
  xi.lo = std::max(xi.lo, kTinyXi);
  xi.hi = std::min({xi.hi, problem.test.xi_max, std::max(kXiCap, 10.0 * xi.lo)});
}

TwoModeEquation MemberChart::Equation(const ExperimentTarget& target, double xi_i, double phase_rad,
                                      double gain, double second, double N) const {
  // With M and N both given, so is their ratio.
  const bool as_ratio = relative || shared_N;
  const double held = !relative && shared_N ? second / N : second;
  return MakeTwoModeEquation(target.frequency_hz, xi_i, ratio, phase_rad, gain,
                             as_ratio ? HeldSecond::kMOverN : HeldSecond::kM, held);
}

std::optional<double> MemberChart::NOfGain(const Complex<double>& first,
                                           const Complex<double>& other, double gain,
                                           double second) const {
  if (!two_modes || relative) {
    return gain / Magnitude(first + (relative ? second : 0.0) * other);
  }
  const double b = second * (first.re * other.re + first.im * other.im);
  const double c = second * second * SquaredMagnitude(other) - gain * gain;
  const double discriminant = b * b - SquaredMagnitude(first) * c;
  if (!(discriminant >= 0.0)) return std::nullopt;
  return (std::sqrt(discriminant) - b) / SquaredMagnitude(first);
}

}  // namespace howl
