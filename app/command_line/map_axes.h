// The axes of a stability chart, as `howl predict --map X:Y --map-x FROM:TO:STEP --map-y ...` asks
// for them.
#ifndef HOWL_APP_COMMAND_LINE_MAP_AXES_H_
#define HOWL_APP_COMMAND_LINE_MAP_AXES_H_

#include <optional>
#include <span>
#include <vector>

#include "app/command_line/options.h"
#include "estimation/family/answers/predict/stability_map.h"
#include "io/config/config.h"

namespace howl {

// The quantities of --map; those of an axis whose range is not given have no values yet.
struct AskedMap {
  MapAxis x, y;
  bool HasOperatingAxis() const;
};

// No value without --map. Throws UsageError for an unknown quantity, the same one twice, a range
// that leaves what the quantity can be, and --map-x or --map-y without --map.
std::optional<AskedMap> ParseMap(const Config& config, const Options& options);

// Fills the ranges that were not given: the operating parameter's from the first measured point to
// the last, a parameter's from half of the least to one and a half times the largest that 95 % of
// the members have at the points.
void FillRanges(const OperatingPoints& points, std::span<const MemberPath> paths,
                const std::vector<double>& phi, AskedMap& map);

}  // namespace howl

#endif  // HOWL_APP_COMMAND_LINE_MAP_AXES_H_
