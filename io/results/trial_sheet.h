// sheet.md: the score sheet for reading.
#ifndef HOWL_IO_RESULTS_TRIAL_SHEET_H_
#define HOWL_IO_RESULTS_TRIAL_SHEET_H_

#include <string>

#include "trial/score.h"

namespace howl {

// `command`: what reproduces the trial; `seal`: the seal's SHA-256.
std::string TrialSheet(const ScoreSheet& sheet, const std::string& command,
                       const std::string& seal);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_TRIAL_SHEET_H_
