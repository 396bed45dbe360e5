// Members of the family, spread over the whole set: as MemberDrawer draws them, in parallel and the
// same for any number of threads.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_ENUMERATE_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_ENUMERATE_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include "estimation/family/members/drawer/member_drawer.h"
#include "estimation/family/problem/problem.h"

namespace howl {

struct EnumerationCounts {
  std::size_t requested = 0;
  std::size_t drawn = 0;     // attempts
  std::size_t complete = 0;  // attempts that reached a full set of parameters and were tested
  std::size_t members = 0;   // of these, the ones that passed
};

struct Enumeration {
  std::vector<Member> members;
  EnumerationCounts counts;
};

// Where the test looks at transfers the members are drawn uniformly, by chains: a member's
// parameters then lie within a few percent, and there is no broader density to aim at.
//
// Up to `count` members: fewer where attempts run out, none where the family is (or seems) empty.
// The same for a seed whatever the number of threads (0: all cores).
Enumeration EnumerateMembers(const FamilyProblem& problem, std::size_t count, std::uint64_t seed,
                             int threads = 1);

// The same with a drawer that exists already, because its pilot search is expensive.
Enumeration EnumerateMembers(const FamilyProblem& problem, const MemberDrawer& drawer,
                             std::size_t count, std::uint64_t seed, int threads = 1);

Enumeration EnumerateMembers(const std::vector<Experiment>& experiments, const ModelSpec& model,
                             const MembershipTest& test, std::size_t count, std::uint64_t seed,
                             int threads = 1);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_ENUMERATE_H_
