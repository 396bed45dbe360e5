// The profile of a quantity over the family (estimation/family/answers/profile.h). The cost of a
// model is the largest share of its tolerance that any of its errors uses (gain, phase, loop phase,
// second crossing, transfer), the test's other conditions being kept: zero is a perfect fit, and
// one is the edge of the family.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_FAMILY_PROFILE_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_FAMILY_PROFILE_H_

#include <optional>
#include <string>
#include <vector>

#include "estimation/family/answers/profile.h"
#include "estimation/family/bounds/expression.h"
#include "estimation/family/local/local_search.h"

namespace howl {

// The points' parameters: omega_hz, xi, N, M, tau_s of each experiment in turn.
inline constexpr std::size_t kProfileParameters = 5;

// The profile is followed from the best-fitting member near `members` to the farthest members of
// both directions. No value where no local search can be made
// (estimation/family/local/local_search.h) or none of `members` is one.
std::optional<Profile> ProfileFamily(const FamilyProblem& problem, const MemberQuantity& quantity,
                                     const std::vector<Member>& members,
                                     std::size_t max_points = 30);

// A quantity as a user names it: EXPERIMENT.loop_gain, or an expression of parameters that belongs
// to no experiment by itself, such as exp1.tau_s or exp1.xi / exp2.xi.
std::optional<MemberQuantity> ParseQuantity(const std::string& text, const FamilyProblem& problem,
                                            ExpressionError& error);

// The same from an expression, for experiment `index`.
MemberQuantity QuantityOf(const Expression& expression, const FamilyProblem& problem,
                          std::size_t index);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_FAMILY_PROFILE_H_
