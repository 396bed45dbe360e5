// Boxes that hold members only: the falsification test evaluated once on intervals, through the
// same templates of model/ that the test itself uses.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_INSIDE_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_INSIDE_H_

#include <vector>

#include "estimation/family/problem/problem.h"

namespace howl {

// Natural units, one for each experiment; M = [0, 0] for one mode.
struct ModelBox {
  Range omega_hz, xi, N, M, tau_s;
};

enum class BoxVerdict { kInside, kOutside, kUnknown };

// kInside: every point passes the test. kOutside: none does. Shared parameters and the domain are
// not looked at: the box is taken in natural coordinates of each experiment.
BoxVerdict TestBox(const FamilyProblem& problem, const std::vector<ModelBox>& box);

// The largest box around a member, with sides in fixed proportion, that the test proves inside;
// empty where the member lies too near an edge (below `smallest` of its parameters).
std::vector<ModelBox> GrowInside(const FamilyProblem& problem, const Member& member,
                                 double smallest = 1e-9);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_INSIDE_H_
