// One experiment's members in the coordinates that enumeration, sampling and the trade-off of two
// modes share: xi, theta = arg G, the gain |G| and the loop phase error, each within its target
// (targets.h). With one mode, omega and N follow from the closed form; with two, a further
// coordinate is omega, or the second mode (M or M / N) where the experiments share it:
// estimation/analysis/loop/closed_form.h and estimation/fit/two_mode_solve.h have the equations.
// tau follows from theta and the loop phase error by (3).
//
// The local search has the same coordinates as logarithms with derivatives
// (estimation/family/local/local_point.h), and takes (3) from the closed form too.
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_MEMBER_CHART_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_MEMBER_CHART_H_

#include <optional>
#include <vector>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/family/problem/problem.h"
#include "estimation/family/problem/targets.h"
#include "estimation/fit/two_mode_solve.h"

namespace howl {

struct MemberChart {
  // `margin`: as of MakeTargets.
  explicit MemberChart(const FamilyProblem& problem, double margin = 1e-9);

  double Tau(const ExperimentTarget& target, double phase_rad, double loop_phase_error_rad) const {
    return TauFromPhase(target.frequency_hz, phase_rad, loop_phase_error_rad, delay_periods);
  }
  double LoopPhaseError(const ExperimentTarget& target, double phase_rad, double tau_s) const {
    return LoopTurns(phase_rad, delay_periods) - target.w_rad_s * tau_s;
  }

  // The largest omega that two modes can have, and the only one of one mode.
  static double TopOmega(const ExperimentTarget& target, double xi_i, double phase_rad) {
    return OneModeOmega(target.frequency_hz, xi_i, phase_rad);
  }
  // Its roots are the omega at which the second mode is `second`, M or M / N. `N` is asked where it
  // is shared, and not otherwise.
  TwoModeEquation Equation(const ExperimentTarget& target, double xi_i, double phase_rad,
                           double gain, double second, double N) const;
  ModeCoefficients Coefficients(const ExperimentTarget& target, double omega_hz, double xi_i,
                                double phase_rad, double gain) const {
    return CoefficientsFromResponse(target.frequency_hz, omega_hz, xi_i, ratio, phase_rad, gain);
  }
  // N from |N U_1 + M U_r| = gain, the larger root, with `first` U_1, `other` U_r (zero with one
  // mode) and `second` M or M / N. No value where M alone is more.
  std::optional<double> NOfGain(const Complex<double>& first, const Complex<double>& other,
                                double gain, double second) const;
  double MOf(double second, double N) const { return relative ? second * N : second; }

  std::vector<ExperimentTarget> targets;
  bool two_modes, relative;  // relative: the second mode is M / N
  ParameterKind second_kind;
  bool shared_omega, shared_xi, shared_N, shared_second, shared_tau;
  double ratio;
  int delay_periods;
  // Within which xi is drawn: the domain's and the test's range, and what has enough digits.
  Range xi;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_MEMBER_CHART_H_
