// plan.json, schema howl.plan/1: the results of `howl diagnose --plan`.
#ifndef HOWL_IO_RESULTS_PLAN_JSON_H_
#define HOWL_IO_RESULTS_PLAN_JSON_H_

#include <nlohmann/json.hpp>

#include "diagnosis/plan/plan.h"

namespace howl {

// simulated: the records were simulated from the config's fit. A size that no trial reached is
// null, as is a gain where the samples themselves show the effect.
nlohmann::ordered_json PlanJson(const Plan& plan, bool simulated);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_PLAN_JSON_H_
