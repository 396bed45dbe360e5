// Where the values of a shared effect's parameters (shared_effect.h) are looked for.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_EFFECT_RANGES_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_EFFECT_RANGES_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/loop_budget/trials/loop_trial.h"

namespace howl {

// The search's coordinates u: of each parameter its logarithm where its scale is logarithmic, else
// the parameter itself.
double ToSearch(const EffectParameter& parameter, double value);
double FromSearch(const EffectParameter& parameter, double u);
Eigen::VectorXd ToSearch(const Effect& effect, const std::vector<double>& values);

// By which the ranges and starts of the catalogue, made for the cycles of the paper's rig, are
// multiplied for these: in seconds they go with the cycle's period, in Hz with its frequency.
double RangeFactor(const Effect& effect, const EffectParameter& parameter,
                   const LoopRecords& records);
// Of u.
Eigen::VectorXd RangeEnd(const Effect& effect, double EffectParameter::*end,
                         const LoopRecords& records);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_EFFECT_RANGES_H_
