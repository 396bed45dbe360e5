// DIR/NAME_next.yaml, NAME being the config's: that config with what a diagnosis found, as far as a
// config can state it (diagnosis/verdict/budget.h), so that `howl fit` of it fits that loop to what
// the records are without the instruments.
#ifndef HOWL_APP_DIAGNOSE_NEXT_CONFIG_H_
#define HOWL_APP_DIAGNOSE_NEXT_CONFIG_H_

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"
#include "io/config/config.h"

namespace howl {

std::filesystem::path NextConfigPath(const Config& config, const std::filesystem::path& out);

// Nothing where there is no more to say, or where what was found in records that had been corrected
// already cannot be stated: a response beside a table of another, and a leak beside a response or a
// delay. Its paths are as they read from any folder. `names`: of the records that were diagnosed,
// in their order.
std::optional<std::string> NextConfig(const Config& config, const std::vector<std::string>& names,
                                      const LoopDiagnosis& found);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_NEXT_CONFIG_H_
