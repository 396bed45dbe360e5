// The values that an option such as --at asks for: numbers and ranges, joined by commas,
// "0.6,0.5:0.7:0.01".
#ifndef HOWL_APP_COMMAND_LINE_ASKED_POINTS_H_
#define HOWL_APP_COMMAND_LINE_ASKED_POINTS_H_

#include <cstddef>
#include <string>
#include <vector>

namespace howl {

inline constexpr std::size_t kMostAskedPoints = 10000;

// The points in the order given; FROM:TO:STEP gives FROM + k STEP up to TO. Throws UsageError,
// which names the option, for what is no number, a step that is not positive, a range that runs
// down, and more points than `most`.
std::vector<double> ParseAskedPoints(const std::string& option, const std::string& text,
                                     std::size_t most = kMostAskedPoints);

}  // namespace howl

#endif  // HOWL_APP_COMMAND_LINE_ASKED_POINTS_H_
