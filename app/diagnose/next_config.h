// DIR/next.yaml: the config of a diagnosis with what was found, as far as a config can state it
// (diagnosis/verdict/budget.h), so that `howl fit DIR/next.yaml` fits that loop to what the records
// are without the instruments.
#ifndef HOWL_APP_DIAGNOSE_NEXT_CONFIG_H_
#define HOWL_APP_DIAGNOSE_NEXT_CONFIG_H_

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_budget.h"
#include "io/config/config.h"

namespace howl {

// Nothing where there is no more to say, or where a record has a table of a response beside which
// one was found. Its paths are as they read from any folder.
// `names`: of the records that were diagnosed, in their order.
std::optional<std::string> NextConfig(const Config& config, const std::vector<std::string>& names,
                                      const LoopDiagnosis& found);

}  // namespace howl

#endif  // HOWL_APP_DIAGNOSE_NEXT_CONFIG_H_
