// The Jacobian of a joint problem at a point, by experiments, with weights and losses applied.
#ifndef HOWL_ESTIMATION_FIT_LINEARISE_H_
#define HOWL_ESTIMATION_FIT_LINEARISE_H_

#include <vector>

#include "estimation/fit/jacobian_block.h"
#include "estimation/fit/joint_problem.h"

namespace howl {

// The columns belong to the free parameters that are no nuisance (q_noise), in their order. The
// part that an experiment's nuisance can explain is projected out of each column, so that J^T J is
// the Schur complement.
std::vector<JacobianBlock> Linearise(const JointProblem& problem, std::vector<double> logs);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_LINEARISE_H_
