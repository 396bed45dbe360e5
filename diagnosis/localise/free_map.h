// Slack of a channel without memory: true signal = recorded + sum over j of c_j T_j(recorded / A),
// j = 2 ... 5, T_j Chebyshev's polynomials, A the largest value in all experiments. In cut A alone:
//
//   recorded p bent   E_A = P + sum c_j H_j - R Q     recorded q bent   E_A = P - R (Q + sum c_j
//   H_j)
//
// In cut B the flame's own characteristic absorbs a bent q.
#ifndef HOWL_DIAGNOSIS_LOCALISE_FREE_MAP_H_
#define HOWL_DIAGNOSIS_LOCALISE_FREE_MAP_H_

#include <vector>

#include "diagnosis/effect_fit.h"

namespace howl {

inline constexpr Eigen::Index kMapTerms = 4;

// The base's fit with the map in cut A: acoustic_cost and residuals are with it.
EffectFit FitFreeMap(const std::vector<CutRecord>& records, bool pressure, const EffectFit& base);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOCALISE_FREE_MAP_H_
