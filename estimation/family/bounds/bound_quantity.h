// The quantity that a search for a bound maximises: sign * value, where the value is a parameter of
// one experiment's model, or an expression in its place. sign = -1 asks for the lower end.
//
//   sign * value of a member  <=  reach of a cell        for every member in the cell
//
// Units: those of the parameter or the expression.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_QUANTITY_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_QUANTITY_H_

#include <cstddef>
#include <span>

#include "estimation/family/bounds/contract/cell.h"
#include "estimation/family/bounds/contract/cell_contractor.h"
#include "estimation/family/bounds/expression.h"
#include "estimation/family/problem/family_parameter.h"
#include "estimation/family/problem/problem.h"

namespace howl {

struct BoundQuantity {
  std::size_t experiment = 0;
  FamilyParameter parameter = FamilyParameter::kOmega;
  double sign = 1.0;                       // +1: upper end
  const Expression* expression = nullptr;  // in the parameter's place
  bool shared = false;                     // a parameter that all experiments have the same of

  bool DependsOn(std::size_t other) const {
    return expression ? expression->DependsOn(other, experiment) : shared || other == experiment;
  }
};

// The value without the sign. A loop gain is that with the slope at rest at which it reaches
// farthest, of all slopes that the data allow.
double ValueOf(const BoundQuantity& quantity, const FamilyProblem& problem,
               std::span<const LoopModel> models);

// The sign * value that the cell reaches.
double ReachOf(const BoundQuantity& quantity, const FamilyProblem& problem,
               const CellContractor& contractor, const Cell& cell);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_BOUND_QUANTITY_H_
