// Local searches over the family: from a start to a member, and from a member to the farthest that
// a quantity reaches within the family.
//
// Interior-point steps (estimation/family/local/local_barrier.h) in the coordinates in which most
// conditions of the test are bounds (estimation/family/local/local_coordinates.h). Every iterate
// keeps the hard conditions strictly, so that what is found is a member. A local search proves
// nothing: it makes `inner` wide, never `outer` tight.
#ifndef HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_SEARCH_H_
#define HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_SEARCH_H_

#include <memory>
#include <optional>

#include "estimation/family/problem/member_quantity.h"
#include "estimation/family/problem/problem.h"

namespace howl {

// The end of a local search: a model, and its largest violation of the conditions that were
// minimised (the largest error over its tolerance). At most one: the model is a member.
struct LocalSolution {
  Member member;
  double violation = 0.0;
  bool converged = false;
};

class LocalSearch {
 public:
  explicit LocalSearch(const FamilyProblem& problem);
  ~LocalSearch();
  LocalSearch(const LocalSearch&) = delete;
  LocalSearch& operator=(const LocalSearch&) = delete;

  // False where omega, xi or N is shared, or omega_spread_max is zero.
  bool IsSupported() const;

  // Minimises the largest violation of all conditions until it is below `enough`. No value where
  // the start is no model of the kind (a second mode that no omega goes with).
  std::optional<LocalSolution> ReduceViolation(const Member& start, double enough = 0.97) const;

  // Minimises the largest violation of the conditions in `soft` among the models that keep the
  // others, `start` being one. With a quantity, among those where it has the value `at`.
  std::optional<LocalSolution> Minimise(const Member& start, const ConditionSet& soft,
                                        const MemberQuantity* quantity = nullptr,
                                        double at = 0.0) const;

  // The member with the largest sign * quantity that the search reaches from `start`, a member;
  // `scale`: a typical range of the quantity. No value where it found none.
  std::optional<Member> Farthest(const Member& start, const MemberQuantity& quantity, double sign,
                                 double scale) const;

  // A model for each experiment with that damping and about that M / N, at the measured phase and
  // gain, to start from; no value where there is no such model.
  std::optional<Member> Nominal(double xi, double relative) const;

  // A model for each experiment from the centre of its transfer and the characteristics, to start
  // from; no value where an experiment has no transfer, or no such model.
  std::optional<Member> FromTransfer() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_LOCAL_LOCAL_SEARCH_H_
