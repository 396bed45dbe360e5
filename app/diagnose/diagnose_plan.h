// howl diagnose --plan: what a diagnosis could find, before it is run (diagnosis/plan/plan.h).
#ifndef HOWL_APP_DIAGNOSE_DIAGNOSE_PLAN_H_
#define HOWL_APP_DIAGNOSE_DIAGNOSE_PLAN_H_

#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "io/config/config.h"

namespace howl {

// Writes plan.json, prints the table. withheld: effects that are left out. Throws UserError, and
// UsageError where another option asks for a diagnosis.
int RunPlan(const Config& config, const Options& options, const std::vector<std::string>& withheld);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_DIAGNOSE_PLAN_H_
