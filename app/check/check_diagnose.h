// What `howl diagnose` can do with a config, in words.
#ifndef HOWL_APP_CHECK_CHECK_DIAGNOSE_H_
#define HOWL_APP_CHECK_CHECK_DIAGNOSE_H_

#include <string>

#include "app/input/problem_input.h"
#include "io/config/config.h"

namespace howl {

// `input` is of `config`. Throws UserError where it can do nothing.
std::string WhatDiagnoseCanDo(const Config& config, const ProblemInput& input);

}  // namespace howl

#endif  // HOWL_APP_CHECK_CHECK_DIAGNOSE_H_
