// How the joint fit searches.
#ifndef HOWL_ESTIMATION_SOLVER_SPEC_H_
#define HOWL_ESTIMATION_SOLVER_SPEC_H_

namespace howl {

struct SolverSpec {
  int starts = 8;            // the closed-form start, and others spread around it
  int max_iterations = 200;  // of each start
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_SOLVER_SPEC_H_
