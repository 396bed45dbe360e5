// The family of test R228, with one mode and with two (configs/r228_two_modes.yaml).
#ifndef HOWL_BENCH_R228_FAMILY_H_
#define HOWL_BENCH_R228_FAMILY_H_

#include "estimation/family/problem/problem.h"
#include "tests/r228.h"

namespace howl {

inline FamilyProblem R228Family(int modes) {
  FamilyProblem problem;
  problem.experiments = R228();
  problem.model.modes = modes;
  if (modes == 1) return problem;
  for (std::size_t i = 0; i < 4; ++i) problem.experiments[i].lines = {{750.0, 10.0}};
  problem.domain[ParameterKind::kOmega].lo = 150.0;
  problem.domain[ParameterKind::kXi].lo = 0.02;
  problem.domain[ParameterKind::kM].hi = 5000.0;
  problem.test.second_crossing_tolerance_deg = 30.0;
  problem.test.xi_max = 0.4;
  return problem;
}

}  // namespace howl

#endif  // HOWL_BENCH_R228_FAMILY_H_
