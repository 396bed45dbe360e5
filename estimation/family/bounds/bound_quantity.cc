#include "estimation/family/bounds/bound_quantity.h"

#include <cmath>

namespace howl {

namespace {

CellVariable VariableOf(FamilyParameter parameter) {
  switch (parameter) {
    case FamilyParameter::kOmega:
      return kCellOmega;
    case FamilyParameter::kXi:
      return kCellXi;
    case FamilyParameter::kN:
      return kCellN;
    case FamilyParameter::kM:
      return kCellM;
    case FamilyParameter::kTau:
      return kCellTau;
    case FamilyParameter::kLoopGain:
      return kCellGain;
  }
  return kCellOmega;
}

}  // namespace

double ValueOf(const BoundQuantity& quantity, const FamilyProblem& problem,
               std::span<const LoopModel> models) {
  const std::size_t i = quantity.experiment;
  if (quantity.expression) return quantity.expression->Evaluate(problem.experiments, models, i);
  const Experiment& experiment = problem.experiments[i];
  const double value = ParameterValue(experiment, models[i], quantity.parameter);
  if (quantity.parameter != FamilyParameter::kLoopGain || value == 0.0) return value;
  const double slope =
      quantity.sign > 0.0 ? experiment.SteepestSlope() : experiment.FlattestSlope();
  return value * slope / std::abs(*experiment.flame_slope);
}

double ReachOf(const BoundQuantity& quantity, const FamilyProblem& problem,
               const CellContractor& contractor, const Cell& cell) {
  if (quantity.expression) {
    const RoundingGuard guard;
    const Interval value = quantity.expression->Evaluate(
        problem.experiments, cell, problem.model.harmonic_ratio, quantity.experiment);
    return quantity.sign > 0.0 ? value.upper() : -value.lower();
  }
  Interval value = cell.boxes[quantity.experiment][VariableOf(quantity.parameter)];
  if (quantity.parameter == FamilyParameter::kLoopGain) {
    const RoundingGuard guard;
    const Experiment& experiment = problem.experiments[quantity.experiment];
    value = value * contractor.Targets()[quantity.experiment].w_rad_s *
            Interval(experiment.FlattestSlope(), experiment.SteepestSlope());
  }
  return quantity.sign > 0.0 ? value.upper() : -value.lower();
}

}  // namespace howl
