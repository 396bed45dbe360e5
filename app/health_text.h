// The last lines of fit and analyse: what speaks against the numbers above them.
#ifndef HOWL_APP_HEALTH_TEXT_H_
#define HOWL_APP_HEALTH_TEXT_H_

#include <string>

#include "estimation/health/finding.h"

namespace howl {

// `sound` is said where there is no finding. The gravest come first; of a kind that has many, the
// first few, and how many more there are in `file`.
std::string HealthText(const Health& health, const std::string& sound, const std::string& file);

}  // namespace howl

#endif  // HOWL_APP_HEALTH_TEXT_H_
