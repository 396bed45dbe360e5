// The paper's loop with two oscillators: section 4, "using tau = 0.00346, omega = 2 pi 215 and
// xi = 0.2", with the slope of table 3 and N from table 2 (experiment 1) by the closed form of
// (5c).
#ifndef HOWL_TESTS_MODEL_PAPER_LOOP_H_
#define HOWL_TESTS_MODEL_PAPER_LOOP_H_

#include "model/loop/laplace.h"

namespace howl {

inline ClosedLoop PaperLoop(double m_over_n) {
  constexpr double kN = 6609.0;
  return {{{215.0, 0.2, kN, m_over_n * kN, 3.0}, 0.00346},
          {FlameShape::kTanh, -0.703e-4, 0.5, 0.0}};
}

}  // namespace howl

#endif  // HOWL_TESTS_MODEL_PAPER_LOOP_H_
