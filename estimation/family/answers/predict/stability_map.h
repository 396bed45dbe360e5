// Stability charts of the family: the growth rate at rest over two quantities x and y, each the
// operating parameter or a parameter of the loop (a time delay that could be moved, damping that
// could be added).
//
// Each member's path (operating_path.h) gives its loop at the point's operating parameter; a
// parameter that is an axis is then set to the point's value, and all else stays. The growth rate
// is that of leading_pole.h: it is zero exactly where |L(j 2 pi f) Phi'(0)| = 1 at a phase crossing
// f. A point has the median of the members, and the interval that holds 95 % of them: the contours
// median = 0, lo = 0 and hi = 0 are the boundary of stability and its band over the family.
//
// x and y in the units of their names: omega_hz in Hz, tau_s in s, N and M in (units of p per unit
// of q) * rad/s, flame_slope Phi'(0) < 0 in (units of q) / (units of p / s); growth rates in 1/s.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_STABILITY_MAP_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_STABILITY_MAP_H_

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "estimation/family/answers/predict/operating_path.h"
#include "estimation/family/answers/predict/predict_points.h"

namespace howl {

enum class MapQuantity : std::uint8_t { kOperatingPoint, kOmega, kXi, kN, kM, kTau, kFlameSlope };

// Those that are parameters of a loop. "phi" stands for the operating parameter in files.
inline constexpr std::array kMapParameters = {MapQuantity::kOmega, MapQuantity::kXi,
                                              MapQuantity::kN,     MapQuantity::kM,
                                              MapQuantity::kTau,   MapQuantity::kFlameSlope};
constexpr std::string_view MapQuantityName(MapQuantity quantity) {
  constexpr std::array<std::string_view, 7> kNames = {"phi", "omega_hz", "xi",         "N",
                                                      "M",   "tau_s",    "flame_slope"};
  return kNames[static_cast<std::size_t>(quantity)];
}

// A loop's value of a parameter, and the loop with another one.
double MapValue(const OperatingLoop& loop, MapQuantity parameter);
OperatingLoop WithMapValue(OperatingLoop loop, MapQuantity parameter, double value);

struct MapAxis {
  MapQuantity quantity = MapQuantity::kOperatingPoint;
  std::vector<double> values;  // ascending
};

struct MapCell {
  std::size_t members = 0;   // paths that have a loop there whose pole could be followed
  SampledValue growth_rate;  // 1/s
  // Of the paths with a loop; NaN without any.
  double share_unstable = std::numeric_limits<double>::quiet_NaN();

  // For 97.5 % of the paths; both are false where there is none.
  bool Grows() const { return growth_rate.lo > 0.0; }
  bool Decays() const { return growth_rate.hi <= 0.0; }
};

struct StabilityMap {
  MapAxis x, y;
  std::size_t paths = 0;
  std::vector<MapCell> cells;  // cell (i, j) of x.values[i], y.values[j] at j x.values.size() + i
  const MapCell& At(std::size_t i, std::size_t j) const { return cells[j * x.values.size() + i]; }
};

// Maps take so many of the paths, evenly: an interval of 95 % needs no more.
inline constexpr std::size_t kMostMapPaths = 200;

// Where neither axis is the operating parameter, the loops are those at `phi`. The paths know a
// flame slope: without one no loop grows or decays. The result does not depend on `threads`.
StabilityMap MakeStabilityMap(const OperatingPoints& points, std::span<const MemberPath> paths,
                              const MapAxis& x, const MapAxis& y, double phi, int threads);

// 95 % of the values that the paths' loops have at the operating point; without an answer NaN.
SampledValue MapValuesAt(const OperatingPoints& points, std::span<const MemberPath> paths,
                         MapQuantity parameter, double phi);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_PREDICT_STABILITY_MAP_H_
