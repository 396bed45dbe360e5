// Which column is time, and in which unit.
#ifndef HOWL_IO_INSPECT_TIME_GUESS_H_
#define HOWL_IO_INSPECT_TIME_GUESS_H_

#include <span>
#include <string>

#include "io/inspect/record_look.h"

namespace howl {

// Rates that records of thermoacoustic cycles are taken at. A unit of time that leads out of this
// range is not the one: 20 Hz is the slowest cycle that is looked for (LowestSearched), and less
// than ten samples a cycle leave nothing of its harmonics; no transducer of pressure that stands a
// flame is faster than some hundred kHz.
inline constexpr double kLeastUsualRateHz = 200.0;
inline constexpr double kMostUsualRateHz = 2e6;

// The first column whose name says so, else the first whose values grow by even steps and are no
// count of samples. `time` may have a stated rate already, which then tells the unit.
void GuessTime(std::span<const ColumnLook> columns, TimeGuess& time);

// "ms" where the config has to say it; empty where it need not.
std::string UnitText(const TimeGuess& time);

}  // namespace howl

#endif  // HOWL_IO_INSPECT_TIME_GUESS_H_
