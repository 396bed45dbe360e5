// Prints a plan on the terminal: what these records can tell apart, at which size, and which
// measurement would separate the rest.
#ifndef HOWL_APP_TEXT_PLAN_TEXT_H_
#define HOWL_APP_TEXT_PLAN_TEXT_H_

#include <string>

#include "diagnosis/plan/plan.h"

namespace howl {

// records: what the plan was made for.
std::string PlanText(const Plan& plan, const std::string& records);

}  // namespace howl

#endif  // HOWL_APP_TEXT_PLAN_TEXT_H_
