// solution.json, schema howl.solution/1: what `howl fit` found.
#ifndef HOWL_IO_RESULTS_SOLUTION_JSON_H_
#define HOWL_IO_RESULTS_SOLUTION_JSON_H_

#include <nlohmann/json.hpp>
#include <optional>

#include "estimation/analysis/loop/vanishing_phi.h"
#include "estimation/fit/joint_fit.h"
#include "estimation/fit/mode_branch.h"

namespace howl {

// Numbers that are not known or not finite become null. `branches`: of two modes.
nlohmann::ordered_json SolutionJson(const JointProblem& problem, const JointFit& fit,
                                    const VanishingPhi& vanishing_phi,
                                    const std::optional<BranchComparison>& branches = std::nullopt);

// {"value", "lo", "hi"}, or null where the line through the loop gains says nothing.
nlohmann::ordered_json VanishingJson(const VanishingPhi& vanishing_phi);

// A number, or null where it is not finite.
nlohmann::ordered_json NumberOrNull(double value);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_SOLUTION_JSON_H_
