// How members lie to one another: parameters in units of their range over the members.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_MEMBER_SPREAD_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_MEMBER_SPREAD_H_

#include <cstddef>
#include <vector>

#include "estimation/family/problem/problem.h"

namespace howl {

inline constexpr std::size_t kModelParameters = 5;

// omega_hz, xi, N, M, tau_s: the k-th of them.
inline double Parameter(const LoopModel& model, std::size_t k) {
  const double values[kModelParameters] = {model.omega_hz, model.xi, model.N, model.M, model.tau_s};
  return values[k];
}

// Indices of `count` members that are well spread: each next one is the farthest from those taken
// (maximin), parameters in units of their range.
std::vector<std::size_t> SpreadMembers(const std::vector<Member>& members, std::size_t count);

// Largest distance from a probe to the nearest drawn member, divided by the square root of the
// number of parameters; of many drawn members some thousands are looked at.
double LargestHole(const std::vector<Member>& drawn, const std::vector<Member>& probes);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_MEMBER_SPREAD_H_
