// Prints the results of `howl family`.
#ifndef HOWL_APP_FAMILY_FAMILY_TEXT_H_
#define HOWL_APP_FAMILY_FAMILY_TEXT_H_

#include "app/family/family_run.h"

namespace howl {

void PrintFamily(const FamilyRun& run);

}  // namespace howl

#endif  // HOWL_APP_FAMILY_FAMILY_TEXT_H_
