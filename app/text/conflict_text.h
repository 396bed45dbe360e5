// Prints on standard output why a family is empty, and what to change.
#ifndef HOWL_APP_TEXT_CONFLICT_TEXT_H_
#define HOWL_APP_TEXT_CONFLICT_TEXT_H_

#include <span>
#include <string>

#include "estimation/family/answers/conflict/conflict.h"

namespace howl {

// `recorded`: experiments whose data a record gives.
void PrintConflict(const FamilyProblem& problem, const Conflict& conflict,
                   std::span<const std::string> recorded);

}  // namespace howl

#endif  // HOWL_APP_TEXT_CONFLICT_TEXT_H_
