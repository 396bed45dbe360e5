// The texts of a trial's key and seal: what was withheld from each case, and the hashes that say
// whether anything has changed since. They depend on the request and on the cases alone, so that
// the shards of a trial join to the same bytes as one machine writes.
#ifndef HOWL_APP_TRIAL_TRIAL_SEAL_H_
#define HOWL_APP_TRIAL_TRIAL_SEAL_H_

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "app/trial/trial_log.h"
#include "app/trial/trial_run.h"

namespace howl {

// By the case's name.
struct SealedCases {
  std::map<std::string, nlohmann::json> withheld;
  std::map<std::string, std::string> sha256;  // Sha256OfFolder
};

// Writes key and seal. Returns the seal's SHA-256, to be logged before the first diagnosis.
std::string WriteSeal(const TrialFolder& folder, const TrialRequest& request,
                      const SealedCases& cases);

}  // namespace howl

#endif  // HOWL_APP_TRIAL_TRIAL_SEAL_H_
