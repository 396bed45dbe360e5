// The effort of a joint fit's search: the config's `solver:`.
#ifndef HOWL_ESTIMATION_FIT_SOLVER_SPEC_H_
#define HOWL_ESTIMATION_FIT_SOLVER_SPEC_H_

namespace howl {

struct SolverSpec {
  int starts = 8;            // the closed form's start, and random ones around it
  int max_iterations = 200;  // for each start
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FIT_SOLVER_SPEC_H_
