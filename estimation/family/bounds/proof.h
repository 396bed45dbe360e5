// A proof that a family is empty, by interval arithmetic: the cell that holds every model of the
// domain is contracted by the conditions (estimation/family/bounds/contract/contract.h), split
// where something is left, and so on, until nothing is. Two bounds that are disjoint leave nothing
// at once.
//
// True is a proof, in spite of rounding. False says nothing: `max_cells` splits may have been too
// few.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_PROOF_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_PROOF_H_

#include <cstddef>

#include "estimation/family/problem/problem.h"

namespace howl {

bool IsProvedEmpty(const FamilyProblem& problem, std::size_t max_cells);

// Enough for what a few seconds can prove, with one mode or with two.
std::size_t ProofCells(const FamilyProblem& problem);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_PROOF_H_
