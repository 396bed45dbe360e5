// A cell of the search for guaranteed bounds: an interval for every parameter of every experiment,
// and for the low end of the window that omega_spread_max allows. N enters an experiment only
// through the gain and tau only through the loop phase, so the tangent t of the phase lag, the gain
// and the loop phase error are variables of their own in addition to the parameters. The conditions
// of the test are then bounds on variables, and the exact relations of closed_form.h and
// two_mode_solve.h link the variables.
#ifndef HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CELL_H_
#define HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CELL_H_

#include <array>
#include <cstddef>
#include <vector>

#include "estimation/family/bounds/contract/interval.h"

namespace howl {

enum CellVariable {
  kCellOmega,      // Hz
  kCellXi,         //
  kCellTangent,    // t = tan(-arg G)
  kCellGain,       // |G|
  kCellN,          // rad/s
  kCellM,          // rad/s
  kCellRelative,   // M / N
  kCellLoopPhase,  // loop phase error, rad
  kCellTau,        // s
  kNumCellVariables
};

using ExperimentBox = std::array<Interval, kNumCellVariables>;

struct Cell {
  Interval window_hz;
  std::vector<ExperimentBox> boxes;
  double bound = 0.0;  // of the objective, set by the search
};

// A cell ends in one of four states, never mixed: outside (no member), inside (members only),
// undecided (it may hold members, and at the precision asked it cannot move a bound), pending (not
// looked at within the budget, or before an interruption).
struct CellCounts {
  std::size_t inside = 0;
  std::size_t outside = 0;
  std::size_t undecided = 0;
  std::size_t pending = 0;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_BOUNDS_CONTRACT_CELL_H_
