// All contractors of a problem (contract.h), experiment by experiment and over what the experiments
// share, until a cell narrows no more.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CELL_CONTRACTOR_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CELL_CONTRACTOR_H_

#include <cstddef>
#include <vector>

#include "estimation/family/bounds/contract/cell.h"
#include "estimation/family/bounds/contract/contract.h"
#include "estimation/family/problem/problem.h"

namespace howl {

class CellContractor {
 public:
  explicit CellContractor(const FamilyProblem& problem);

  // Everything the test's bounds allow, not contracted.
  Cell Root() const;
  bool Contract(Cell& cell) const;

  bool HasWindow() const { return has_window_; }
  bool TwoModes() const { return two_modes_; }
  const std::vector<ContractTarget>& Targets() const { return targets_; }
  // Variables that are one for all experiments.
  const std::vector<CellVariable>& Shared() const { return shared_; }

 private:
  bool ContractExperiment(std::size_t i, ExperimentBox& box) const;
  // Slices xi, contracts each slice and keeps the hull of what is left.
  bool ContractSliced(std::size_t i, ExperimentBox& box) const;
  bool ContractWindow(Cell& cell) const;
  bool ContractChain(Cell& cell) const;
  bool ContractShared(Cell& cell) const;

  std::vector<ContractTarget> targets_;
  std::vector<std::size_t> order_;  // of the experiments, by phi
  std::vector<ExperimentBox> root_;
  std::vector<CellVariable> shared_;
  Interval factor_;
  bool empty_ = false;  // a tolerance leaves nothing by itself
  bool has_window_ = true;
  bool two_modes_ = false;
  bool increasing_ = true;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CELL_CONTRACTOR_H_
