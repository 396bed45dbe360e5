// The band, the operating points and the share of a place: "73 to 363 Hz, 1 experiment
// (share 1.00)".
#ifndef HOWL_APP_TEXT_PLACE_TEXT_H_
#define HOWL_APP_TEXT_PLACE_TEXT_H_

#include <string>

#include "app/text/text_table.h"
#include "diagnosis/fit/estimated_parameter.h"
#include "io/report/summary/words.h"

namespace howl {

inline std::string ExtentText(const Place& place) {
  const std::string low = Fixed(place.low_hz, 0);
  const std::string high = Fixed(place.high_hz, 0);
  return (low == high ? low : low + " to " + high) + " Hz, " +
         Counted(place.experiments.size(), "experiment") + " (share " + Fixed(place.share, 2) + ")";
}

}  // namespace howl

#endif  // HOWL_APP_TEXT_PLACE_TEXT_H_
