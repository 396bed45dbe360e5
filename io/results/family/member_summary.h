// What a list of members is, in a few figures that a later list is compared with.
//
// For each experiment and parameter:
//
//   quantiles  least, quarter, half, three quarters, largest value
//   digests    two hashes of all values, in the list's order and cut to seven significant digits:
//              to the nearest, and downwards
//
// The quantiles say how far a list moved; one member of a thousand that moves need not move them.
// The digests tell any value that moves by more than 1e-6 of itself. The last bit of a value
// differs from compiler to compiler: it changes one of the two where a value lies next to an edge
// of the cut, and then lies amid the other's, so that equal lists have one digest in common.
#ifndef HOWL_IO_RESULTS_FAMILY_MEMBER_SUMMARY_H_
#define HOWL_IO_RESULTS_FAMILY_MEMBER_SUMMARY_H_

#include <nlohmann/json.hpp>
#include <vector>

#include "estimation/family/problem/problem.h"

namespace howl {

// {"exp1": {"omega_hz": {"quantiles": [five numbers], "digests": [two texts]}, ...}, ...}
nlohmann::ordered_json MemberSummaryJson(const FamilyProblem& problem,
                                         const std::vector<Member>& members);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_FAMILY_MEMBER_SUMMARY_H_
