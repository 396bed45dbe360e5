// One sentence on the whole periods that the delay exceeds, which the records may not tell.
#ifndef HOWL_APP_TEXT_DELAY_TEXT_H_
#define HOWL_APP_TEXT_DELAY_TEXT_H_

#include <string>

#include "estimation/analysis/loop/delay.h"

namespace howl {

// Empty where branches were not compared because fewer than three experiments have a phase.
std::string DelayText(const DelayChoice& choice);

// Whether the records left the branch open and the config names none.
bool DelayIsOpen(const DelayChoice& choice);

}  // namespace howl

#endif  // HOWL_APP_TEXT_DELAY_TEXT_H_
