// The budget of a diagnosis on the terminal: a waterfall.
#ifndef HOWL_APP_TEXT_BUDGET_TEXT_H_
#define HOWL_APP_TEXT_BUDGET_TEXT_H_

#include <string>
#include <vector>

#include "diagnosis/verdict/budget.h"

namespace howl {

std::string ParameterText(const std::vector<EstimatedParameter>& parameters);

// A bar as long as the gap before each item, of which the item takes off the light part; then where
// what is left lies.
std::string BudgetText(const Budget& budget);

}  // namespace howl

#endif  // HOWL_APP_TEXT_BUDGET_TEXT_H_
