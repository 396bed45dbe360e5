// Members of a family whose test looks at transfers, found by local searches from the transfers'
// centres: their ellipsoids are far too small for draws at random to meet.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_TRANSFER_STARTS_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_TRANSFER_STARTS_H_

#include <cstdint>
#include <vector>

#include "estimation/family/problem/problem.h"

namespace howl {

// The test looks at a transfer, and the scopes are such that a local search can be made.
bool NeedsTransferStarts(const FamilyProblem& problem);

// `count` members, the first well inside and the others where parameters of randomly chosen
// experiments reach farthest; empty where the search found none. The same for a seed whatever the
// number of threads.
std::vector<Member> TransferStarts(const FamilyProblem& problem, std::size_t count,
                                   std::uint64_t seed = 0, int threads = 1);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_TRANSFER_STARTS_H_
