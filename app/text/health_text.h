// The last lines of fit and analyse: the findings that speak against the numbers above them.
#ifndef HOWL_APP_TEXT_HEALTH_TEXT_H_
#define HOWL_APP_TEXT_HEALTH_TEXT_H_

#include <string>

#include "estimation/health/finding.h"

namespace howl {

// `sound` is printed where there is no finding. The gravest findings come first; of a kind with
// many only the first few are printed, with the number of those that are in `file`.
std::string HealthText(const Health& health, const std::string& sound, const std::string& file);

}  // namespace howl

#endif  // HOWL_APP_TEXT_HEALTH_TEXT_H_
