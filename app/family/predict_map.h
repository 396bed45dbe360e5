// The stability chart of `howl predict --map X:Y`, and the members that it and the prediction
// carry.
#ifndef HOWL_APP_FAMILY_PREDICT_MAP_H_
#define HOWL_APP_FAMILY_PREDICT_MAP_H_

#include <string>
#include <vector>

#include "app/command_line/map_axes.h"
#include "app/family/family_run.h"
#include "io/results/family/stability_map_files.h"

namespace howl {

// The members, 1000 at most, and their paths through the operating points.
struct CarriedMembers {
  OperatingPoints points;
  std::size_t members;
  std::vector<MemberPath> paths;
};
CarriedMembers CarryMembers(const Options& options, const FamilyRun& run);

// `asked`: the points of --at, where the chart has the members' own values; the measured points
// where an axis is the operating parameter.
MapReport MakeMap(const Config& config, const Options& options, const CarriedMembers& carried,
                  const std::vector<double>& asked, AskedMap map);

// For the terminal: what the chart spans, and how much of it is stable.
std::string MapText(const MapReport& report);

}  // namespace howl

#endif  // HOWL_APP_FAMILY_PREDICT_MAP_H_
