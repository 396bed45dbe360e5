// One sentence on the operating point at which the limit cycle vanishes.
#ifndef HOWL_APP_TEXT_VANISHING_TEXT_H_
#define HOWL_APP_TEXT_VANISHING_TEXT_H_

#include <string>

#include "estimation/analysis/loop/vanishing_phi.h"

namespace howl {

// Empty where no line goes through the loop gains (straight_line.h). An interval without an end says
// so instead of giving a number that means nothing.
std::string VanishingText(const VanishingPhi& vanishing, const std::string& operating_parameter);

// What an interval of two points takes for granted, to be added to a sentence; empty for more.
std::string OfTwoText(const VanishingPhi& vanishing);

}  // namespace howl

#endif  // HOWL_APP_TEXT_VANISHING_TEXT_H_
