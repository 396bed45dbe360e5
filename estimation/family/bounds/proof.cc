#include "estimation/family/bounds/proof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "estimation/family/bounds/bound_split.h"
#include "estimation/family/bounds/contract/cell.h"
#include "estimation/family/bounds/contract/cell_contractor.h"

namespace howl {

namespace {

constexpr double kFinest = 1e-9;   // of a root cell: no split below
constexpr std::size_t kTried = 6;  // variables that are tried for a split, with two modes

// The variables that a split may halve. N, M and their ratio follow from the rest; where they are
// shared they are added.
constexpr std::array kSplitVariables = {kCellXi, kCellOmega, kCellTangent, kCellGain, kCellTau};

// The finite width of a variable as a share of the root's; 1 where the root has no finite one.
double Share(const Interval& x, const Interval& root) {
  const double width = Width(x);
  const double whole = Width(root);
  if (!std::isfinite(width)) return 1.0;
  if (!std::isfinite(whole)) return width / (1.0 + std::abs(x.upper()));
  return whole > 0.0 ? width / whole : 0.0;
}

class Prover {
 public:
  explicit Prover(const FamilyProblem& problem) : contractor_(problem), root_(contractor_.Root()) {}

  bool Prove(std::size_t max_cells) {
    if (!contractor_.Contract(root_)) return true;
    std::vector<Cell> left{root_};
    for (std::size_t cells = 0; !left.empty(); ++cells) {
      if (cells >= max_cells) return false;
      Cell cell = std::move(left.back());
      left.pop_back();
      std::optional<std::vector<Cell>> halves = Split(cell);
      if (!halves) return false;
      std::move(halves->begin(), halves->end(), std::back_inserter(left));
    }
    return true;
  }

 private:
  double Size(const Cell& cell) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < cell.boxes.size(); ++i) {
      for (const CellVariable v : {kCellXi, kCellOmega, kCellTangent}) {
        sum += Share(cell.boxes[i][v], root_.boxes[i][v]);
      }
    }
    return sum;
  }

  // The widest variables, as a share of the root's width.
  std::vector<Interval*> Widest(Cell& cell, std::size_t kept) const {
    std::vector<std::pair<double, Interval*>> scored;
    const auto offer = [&](Interval& x, const Interval& root, double weight) {
      if (!std::isfinite(Width(x)) || !(Width(x) > 4e-16 * std::abs(x.upper()))) return;
      const double share = Share(x, root);
      if (share > kFinest) scored.emplace_back(weight * share, &x);
    };
    if (contractor_.HasWindow() && cell.boxes.size() > 1) {
      offer(cell.window_hz, root_.window_hz, 1.0);
    }
    for (std::size_t i = 0; i < cell.boxes.size(); ++i) {
      for (const CellVariable v : kSplitVariables) {
        offer(cell.boxes[i][v], root_.boxes[i][v], v == kCellXi || v == kCellOmega ? 1.0 : 0.5);
      }
    }
    for (const CellVariable v : contractor_.Shared()) {
      offer(cell.boxes[0][v], root_.boxes[0][v], 1.0);
    }
    std::stable_sort(scored.begin(), scored.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Interval*> widest;
    for (std::size_t k = 0; k < std::min(kept, scored.size()); ++k) {
      widest.push_back(scored[k].second);
    }
    return widest;
  }

  // The halves of the cell after contraction, split in the variable that leaves least; no value
  // where the cell is too fine to split.
  std::optional<std::vector<Cell>> Split(Cell& cell) const {
    std::optional<std::vector<Cell>> best;
    double best_size = 0.0;
    for (Interval* const variable : Widest(cell, contractor_.TwoModes() ? kTried : 1)) {
      const Interval whole = *variable;
      std::vector<Cell> halves;
      double size = 0.0;
      for (const Interval& half : Halves(whole)) {
        *variable = half;
        Cell child = cell;
        if (!contractor_.Contract(child)) continue;
        size += Size(child);
        halves.push_back(std::move(child));
      }
      *variable = whole;
      if (best && size >= best_size) continue;
      best = std::move(halves);
      best_size = size;
      if (best->empty()) break;
    }
    return best;
  }

  CellContractor contractor_;
  Cell root_;
};

}  // namespace

bool IsProvedEmpty(const FamilyProblem& problem, std::size_t max_cells) {
  return Prover(problem).Prove(max_cells);
}

std::size_t ProofCells(const FamilyProblem& problem) {
  return problem.model.modes == 1 ? 4000 : 200;
}

}  // namespace howl
