// The smallest changes of an empty family's problem as lines of YAML, each of which stands in place
// of what the config has under the same keys, and as the `conflict` of family.json.
#ifndef HOWL_IO_RESULTS_FAMILY_FAMILY_CHANGES_H_
#define HOWL_IO_RESULTS_FAMILY_FAMILY_CHANGES_H_

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "estimation/family/answers/conflict/conflict.h"

namespace howl {

// omega_spread_max, omega_hz.max, exp1.gain.
std::string ChangeName(const FamilyProblem& problem, const ChangeTarget& target);

// As `family: {test: {omega_spread_max: 0.1836}}`; empty where the change does not help, and for a
// datum that an experiment's record gives: `recorded` names those experiments.
std::string ChangeLine(const FamilyProblem& problem, const SmallestChange& change,
                       std::span<const std::string> recorded);

nlohmann::ordered_json ConflictJson(const FamilyProblem& problem, const Conflict& conflict,
                                    std::span<const std::string> recorded);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_FAMILY_FAMILY_CHANGES_H_
