// Further measurements that a plan tries for the pairs of effects that the records do not separate:
// each is simulated from the base's fit, cut like the records, and counted with them.
#ifndef HOWL_DIAGNOSIS_PLAN_PLAN_TRIALS_H_
#define HOWL_DIAGNOSIS_PLAN_PLAN_TRIALS_H_

#include <memory>
#include <string>
#include <vector>

#include "diagnosis/plan/plan_samples.h"
#include "diagnosis/plan/plan_table.h"

namespace howl {

// One measurement: either further records, or the present ones otherwise.
struct TrialMeasurement {
  std::string what;
  double record_scale = 1.0;  // of the present records' length
  // In the present ones' place; null: they stay.
  std::shared_ptr<EffectFit> fit;
  // One more experiment, and its own base fit; empty: none.
  std::vector<CutRecord> further;
  std::shared_ptr<EffectFit> further_fit;
};

// Records twice as long; half the sensors' noise; a weaker cycle; a stable point, driven by noise;
// a point beyond either end of the operating range. scale: what a record counts for, as
// WeighedPoint has it.
std::vector<TrialMeasurement> TrialMeasurements(const PlanRecords& at);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_PLAN_TRIALS_H_
