// One sentence on the operating point at which the limit cycle vanishes.
#ifndef HOWL_APP_TEXT_VANISHING_TEXT_H_
#define HOWL_APP_TEXT_VANISHING_TEXT_H_

#include <string>

#include "estimation/analysis/loop/vanishing_phi.h"

namespace howl {

// Empty where fewer than three experiments have a loop gain. An interval without an end says so
// instead of giving a number that means nothing.
std::string VanishingText(const VanishingPhi& vanishing, const std::string& operating_parameter);

}  // namespace howl

#endif  // HOWL_APP_TEXT_VANISHING_TEXT_H_
