// One box of parameters contracted: the interval arithmetic of the bounds, without the search
// around it. The boxes are the parts of the family's whole box, xi of each experiment halved.
#include <memory>

#include "bench/limits/measured.h"
#include "bench/r228_family.h"
#include "estimation/family/bounds/contract/cell_contractor.h"

namespace howl::limits {
namespace {

std::vector<Cell> Halved(const std::vector<Cell>& cells, std::size_t experiment) {
  std::vector<Cell> halves;
  for (const Cell& cell : cells) {
    const Interval xi = cell.boxes[experiment][kCellXi];
    const double middle = 0.5 * (xi.lower() + xi.upper());
    for (const Interval& half : {Interval(xi.lower(), middle), Interval(middle, xi.upper())}) {
      halves.push_back(cell);
      halves.back().boxes[experiment][kCellXi] = half;
    }
  }
  return halves;
}

std::function<double()> Prepare(int modes) {
  struct State {
    explicit State(const FamilyProblem& problem) : contractor(problem), cells({contractor.Root()}) {
      contractor.Contract(cells[0]);
      for (std::size_t i = 0; i < problem.experiments.size(); ++i) cells = Halved(cells, i);
    }
    CellContractor contractor;
    std::vector<Cell> cells;
  };
  auto state = std::make_shared<const State>(R228Family(modes));
  return [state, modes] {
    const int times = modes == 1 ? 10 : 1;
    for (int n = 0; n < times; ++n) {
      for (Cell cell : state->cells) state->contractor.Contract(cell);
    }
    return static_cast<double>(times) * static_cast<double>(state->cells.size());
  };
}

}  // namespace

std::vector<Measured> ContractLoads() {
  return {{"enclose, a box contracted, one mode", "box", [] { return Prepare(1); }},
          {"enclose, a box contracted, two modes", "box", [] { return Prepare(2); }}};
}

}  // namespace howl::limits
