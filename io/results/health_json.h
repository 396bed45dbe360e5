// A health as solution.json and analysis.json hold it, under "health": one object a finding,
//
//   {"kind", "experiment", "subject", "value", "limit", "text"}
//
// with null for an experiment or number that does not apply. Empty: nothing was found.
#ifndef HOWL_IO_RESULTS_HEALTH_JSON_H_
#define HOWL_IO_RESULTS_HEALTH_JSON_H_

#include <nlohmann/json.hpp>

#include "estimation/health/finding.h"

namespace howl {

nlohmann::ordered_json HealthJson(const Health& health);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_HEALTH_JSON_H_
