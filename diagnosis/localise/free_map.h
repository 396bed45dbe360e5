// Slack of a channel by a static map, in cut A, with Chebyshev's polynomials T_j, j = 2 ... 7:
//
//   recorded p bent   p_r = p + A sum c_j T_j(p / A),        p = R q_r as the duct makes it
//   recorded q bent   q = q_r + A sum c_j T_j(q_r / A),      p_r = R q
//
// A is the largest value in all experiments. Each map acts on a signal that is known: a saturated p
// cannot be mapped back, but it can be predicted. In cut B the flame's own characteristic absorbs a
// map of q; with a map of p, the flame is driven by R q_r.
#ifndef HOWL_DIAGNOSIS_LOCALISE_FREE_MAP_H_
#define HOWL_DIAGNOSIS_LOCALISE_FREE_MAP_H_

#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "model/loop/instrument.h"

namespace howl {

inline constexpr Eigen::Index kMapTerms = 6;

// The base's fit with the map: costs and residuals include it.
EffectFit FitFreeMap(const std::vector<CutRecord>& records, Channel channel, const EffectFit& base);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOCALISE_FREE_MAP_H_
