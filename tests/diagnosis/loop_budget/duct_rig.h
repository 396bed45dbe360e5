// Operating points of a duct whose loop is known, for diagnoses of records.
#ifndef HOWL_TESTS_DIAGNOSIS_LOOP_BUDGET_DUCT_RIG_H_
#define HOWL_TESTS_DIAGNOSIS_LOOP_BUDGET_DUCT_RIG_H_

#include <cstdint>
#include <string>

#include "diagnosis/loop_budget/loop_records.h"
#include "tests/estimation/record_fit/modal_loop.h"

namespace howl {

// Its operating parameter is the loop's gain, with which the delay grows a little.
inline LoopRecord DuctAt(double gain, double duration_s, std::uint64_t seed) {
  ModalLoop loop = DuctOfModes(2);
  loop.tau_s *= 1.0 + 0.03 * (gain - 1.3);
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  loop.slope = gain / loop.Open(cycle_hz).real();
  return {"gain " + std::to_string(gain), gain, cycle_hz,
          SimulateModalLoop(loop, duration_s, seed)};
}

// The duct's own: two free modes with complex residues, driven by dp/dt.
inline LoopForm DuctsForm() {
  LoopForm out;
  out.structure.modes = 2;
  out.structure.noise = LeastNoise();
  return out;
}

}  // namespace howl

#endif  // HOWL_TESTS_DIAGNOSIS_LOOP_BUDGET_DUCT_RIG_H_
