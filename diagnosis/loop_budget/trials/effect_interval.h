// The values of a shared effect's only parameter that the records do not reject at 95 %:
//
//   { u : max l - l(u) <= 1.96^2 / 2 }
//
// by the profile l (effect_profile.h), whose top is at the null or near it. A parabola through the
// null and two values more foretells top and ends; the ends are moved until the profile there is as
// far below its top.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_EFFECT_INTERVAL_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_EFFECT_INTERVAL_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/loop_budget/trials/effect_profile.h"

namespace howl {

// In the parameter's unit; infinite where the null or the range's end is reached before.
struct EffectInterval {
  double low = 0.0;
  double high = 0.0;
};

// `at_null`: the parameters of each point's fit without the effect.
EffectInterval IntervalOf(const std::vector<Eigen::VectorXd>& at_null, EffectProfile* profile);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_EFFECT_INTERVAL_H_
