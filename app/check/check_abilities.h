// What each command can do with a config, as far as that is known without a fit or a search.
#ifndef HOWL_APP_CHECK_CHECK_ABILITIES_H_
#define HOWL_APP_CHECK_CHECK_ABILITIES_H_

#include <vector>

#include "app/check/check_run.h"
#include "app/input/problem_input.h"
#include "io/config/config.h"

namespace howl {

// `input` is of `config`. Without known operating points nothing is said of what depends on them.
std::vector<Ability> FindAbilities(const Config& config, const Options& options,
                                   const ProblemInput& input, bool points_are_known);

}  // namespace howl

#endif  // HOWL_APP_CHECK_CHECK_ABILITIES_H_
