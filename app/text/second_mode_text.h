// The lines of fit on the loop's crossings, and on the branch of two modes on which the fit is.
#ifndef HOWL_APP_TEXT_SECOND_MODE_TEXT_H_
#define HOWL_APP_TEXT_SECOND_MODE_TEXT_H_

#include <string>

#include "estimation/fit/joint_fit.h"
#include "estimation/fit/mode_branch.h"

namespace howl {

std::string CrossingsText(const JointProblem& problem, const JointFit& fit);

// Empty where the fit is on the paper's branch and the data do not prefer the other.
std::string BranchText(const BranchComparison& comparison);

}  // namespace howl

#endif  // HOWL_APP_TEXT_SECOND_MODE_TEXT_H_
