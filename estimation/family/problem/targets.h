// The test's tolerances on one experiment, as ranges of what they bound: the phase of G, its
// magnitude and the loop phase error. An experiment's members are a box in these and in the
// parameters that they leave free (estimation/analysis/loop/closed_form.h, two_mode_solve.h).
#ifndef HOWL_ESTIMATION_FAMILY_PROBLEM_TARGETS_H_
#define HOWL_ESTIMATION_FAMILY_PROBLEM_TARGETS_H_

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/family/problem/problem.h"
#include "model/numerics/units.h"

namespace howl {

struct ExperimentTarget {
  double frequency_hz = 0.0;
  double w_rad_s = 0.0;
  double phi = 0.0;
  Range phase_rad;             // arg G, within a quarter turn of zero: both modes are dissipative
  Range gain;                  // |G|: gain tolerance and the least loop gain
  Range loop_phase_error_rad;  // within half a turn
  bool IsEmpty() const { return !(phase_rad.lo <= phase_rad.hi) || !(gain.lo <= gain.hi); }
};

// `margin` shrinks every tolerance relatively: what is drawn at an edge then passes the test in
// spite of rounding. Zero for exact work.
inline std::vector<ExperimentTarget> MakeTargets(const FamilyProblem& problem,
                                                 double margin = 1e-9) {
  constexpr double kHalfPi = std::numbers::pi / 2;
  constexpr double kGainCap = 1e4;  // stands for "no upper limit"
  const MembershipTest& test = problem.test;
  std::vector<ExperimentTarget> targets;
  for (const Experiment& experiment : problem.experiments) {
    ExperimentTarget target;
    target.frequency_hz = experiment.frequency_hz;
    target.w_rad_s = kRadPerSPerHz * experiment.frequency_hz;
    target.phi = experiment.phi;
    const double phase = WrapDeg(experiment.phase_deg) * kRadPerDeg;
    const double phase_tolerance =
        std::min(test.phase_tolerance_deg, 180.0) * kRadPerDeg * (1.0 - margin);
    target.phase_rad = {std::max(phase - phase_tolerance, -kHalfPi * (1.0 - 1e-9)),
                        std::min(phase + phase_tolerance, kHalfPi * (1.0 - 1e-9))};
    const double gain_tolerance = test.gain_tolerance * (1.0 - margin);
    target.gain = {experiment.gain * std::max(1.0 - gain_tolerance, 1.0 / kGainCap),
                   experiment.gain * std::min(1.0 + gain_tolerance, kGainCap)};
    if (experiment.reliable && experiment.flame_slope) {
      target.gain.lo = std::max(target.gain.lo, test.loop_gain_min * (1.0 + margin) /
                                                    (target.w_rad_s * experiment.SteepestSlope()));
    }
    const double loop_tolerance =
        std::min(test.loop_phase_tolerance_deg, 180.0) * kRadPerDeg * (1.0 - margin);
    target.loop_phase_error_rad = {-loop_tolerance, loop_tolerance};
    targets.push_back(target);
  }
  return targets;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_PROBLEM_TARGETS_H_
