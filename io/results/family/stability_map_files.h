// What `howl predict --map X:Y` writes beside its prediction.
//
// prediction_map.csv, one row for each point, x within y:
//
//   X,Y,growth_rate_1_s,lo,hi,share_unstable,members
//
// X and Y are the names of the axes ("phi" for the operating parameter, which stands under its own
// name too, in the last column). The growth rate at rest is the median of the members, lo .. hi
// holds 95 % of them; cells are empty where no member has a loop. In prediction.json "map" says
// what the axes are, and the members' own values of them at the measured points.
#ifndef HOWL_IO_RESULTS_FAMILY_STABILITY_MAP_FILES_H_
#define HOWL_IO_RESULTS_FAMILY_STABILITY_MAP_FILES_H_

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "estimation/family/answers/predict/stability_map.h"

namespace howl {

// Where the members themselves are on the map.
struct MapMark {
  double phi = 0.0;
  SampledValue x, y;  // an axis that is the operating parameter has phi in all three places
};

struct MapReport {
  std::string operating_parameter;
  // Of all loops where neither axis is the operating parameter; NaN where one is.
  double phi = std::numeric_limits<double>::quiet_NaN();
  StabilityMap map;
  std::vector<MapMark> marks;
};

std::string StabilityMapCsv(const MapReport& report);
nlohmann::ordered_json StabilityMapJson(const MapReport& report);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_FAMILY_STABILITY_MAP_FILES_H_
