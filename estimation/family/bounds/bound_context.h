// What all searches for the bounds of one family have in common: the problem, the root cell that
// holds every member, the contractor that narrows cells, the searches that find members, and
// members to start from. A search does not change it, so that one context serves all threads.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_CONTEXT_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_CONTEXT_H_

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "estimation/family/bounds/bound_quantity.h"
#include "estimation/family/bounds/contract/cell.h"
#include "estimation/family/bounds/contract/cell_contractor.h"
#include "estimation/family/local/local_search.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/problem/problem.h"

namespace howl {

struct BoundContext {
  BoundContext(const FamilyProblem& family, std::uint64_t seed_of_draws);

  double Value(const BoundQuantity& quantity, std::span<const LoopModel> models) const {
    return ValueOf(quantity, problem, models);
  }
  double Reach(const BoundQuantity& quantity, const Cell& cell) const {
    return ReachOf(quantity, problem, contractor, cell);
  }

  FamilyProblem problem;
  std::uint64_t seed;
  CellContractor contractor;
  LocalSearch local;
  Cell root;                             // contracted
  bool root_empty;                       // proved: no member at all
  std::unique_ptr<MemberDrawer> drawer;  // none where transfers leave it nothing to meet
  std::vector<Member> base;              // over the whole set; empty where none was found
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_CONTEXT_H_
