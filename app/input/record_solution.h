// The loops that a config's records show, where its model is one that records alone can show
// (Config::record_loop): howl fit's answer, which simulate and predict begin with.
#ifndef HOWL_APP_INPUT_RECORD_SOLUTION_H_
#define HOWL_APP_INPUT_RECORD_SOLUTION_H_

#include <cstdint>

#include "app/command_line/options.h"
#include "io/config/config.h"
#include "io/results/record_solution_json.h"

namespace howl {

// For howl fit itself, which fits anew what a complete fit has left, and has the other delays; or
// for a command that takes its loops.
enum class SolvedFor : std::uint8_t { kFit, kLoops };

// Throws UserError where an experiment has no record of both signals that is long enough, and
// Interrupted where the user asks for a stop; the same command then goes on from fit_state.h.
RecordSolution SolveRecords(const Config& config, const Options& options, SolvedFor what);

}  // namespace howl

#endif  // HOWL_APP_INPUT_RECORD_SOLUTION_H_
