// Checks the health of a joint fit: whether the solver converged, which parameters are at a bound
// and whose bound it is, and which residuals lie beyond three standard deviations.
//
// A residual counts by the weight that the fit gives it: sqrt(weight) r. An experiment that is
// called unreliable is given twice its standard deviations, and has them here too. The points of a
// transfer are many, and some lie beyond three by chance: they are a finding where there are more
// than chance gives in one of a thousand such transfers (Poisson's distribution).
#ifndef HOWL_ESTIMATION_HEALTH_FIT_HEALTH_H_
#define HOWL_ESTIMATION_HEALTH_FIT_HEALTH_H_

#include "estimation/fit/joint_fit.h"
#include "estimation/health/finding.h"

namespace howl {

inline constexpr double kLargeResidual = 3.0;  // standard deviations

// fit: the solution of `problem`.
Health CheckFit(const JointProblem& problem, const JointFit& fit);

}  // namespace howl

#endif  // HOWL_ESTIMATION_HEALTH_FIT_HEALTH_H_
