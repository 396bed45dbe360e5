#include "estimation/family/answers/predict/stability_map.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "estimation/family/answers/predict/leading_pole.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

// Evenly spread over the paths, which stand member by member.
std::vector<const MemberPath*> Spread(std::span<const MemberPath> paths) {
  const std::size_t count = std::min(paths.size(), kMostMapPaths);
  std::vector<const MemberPath*> chosen;
  for (std::size_t k = 0; k < count; ++k) chosen.push_back(&paths[k * paths.size() / count]);
  return chosen;
}

// Where the loop has it; none for the operating point.
double* ValueOf(OperatingLoop& loop, MapQuantity parameter) {
  switch (parameter) {
    case MapQuantity::kOmega:
      return &loop.model.omega_hz;
    case MapQuantity::kXi:
      return &loop.model.xi;
    case MapQuantity::kN:
      return &loop.model.N;
    case MapQuantity::kM:
      return &loop.model.M;
    case MapQuantity::kTau:
      return &loop.model.tau_s;
    case MapQuantity::kFlameSlope:
      return &loop.flame_slope;
    case MapQuantity::kOperatingPoint:
      break;
  }
  return nullptr;
}

MapCell Gather(const std::vector<double>& rates) {
  MapCell cell;
  std::size_t unstable = 0;
  for (const double rate : rates) {
    if (!std::isfinite(rate)) continue;
    ++cell.members;
    if (rate > 0.0) ++unstable;
  }
  cell.growth_rate = Summarise(rates);
  if (cell.members > 0) {
    cell.share_unstable = static_cast<double>(unstable) / static_cast<double>(cell.members);
  }
  return cell;
}

}  // namespace

double MapValue(const OperatingLoop& loop, MapQuantity parameter) {
  OperatingLoop copy = loop;
  const double* const value = ValueOf(copy, parameter);
  return value != nullptr ? *value : std::nan("");
}

OperatingLoop WithMapValue(OperatingLoop loop, MapQuantity parameter, double value) {
  if (double* const place = ValueOf(loop, parameter)) *place = value;
  return loop;
}

StabilityMap MakeStabilityMap(const OperatingPoints& points, std::span<const MemberPath> paths,
                              const MapAxis& x, const MapAxis& y, double phi, int threads) {
  const std::vector<const MemberPath*> chosen = Spread(paths);
  StabilityMap map{x, y, chosen.size(), {}};
  const std::size_t columns = x.values.size();
  map.cells.resize(columns * y.values.size());
  RunUnits(map.cells.size(), threads, [&](std::size_t k) {
    const double at_x = x.values[k % columns];
    const double at_y = y.values[k / columns];
    double point = phi;
    if (x.quantity == MapQuantity::kOperatingPoint) point = at_x;
    if (y.quantity == MapQuantity::kOperatingPoint) point = at_y;
    if (points.KindOf(point) == PointKind::kOutside) return;
    std::vector<double> rates;
    for (const MemberPath* const path : chosen) {
      std::optional<OperatingLoop> loop = path->At(points, point);
      if (!loop) continue;
      if (double* const place = ValueOf(*loop, x.quantity)) *place = at_x;
      if (double* const place = ValueOf(*loop, y.quantity)) *place = at_y;
      if (loop->flame_slope == 0.0) continue;
      const std::optional<Pole> pole = LeadingPole(loop->model.Loop(), loop->flame_slope);
      if (pole) rates.push_back(pole->growth_rate);
    }
    map.cells[k] = Gather(rates);
  });
  return map;
}

SampledValue MapValuesAt(const OperatingPoints& points, std::span<const MemberPath> paths,
                         MapQuantity parameter, double phi) {
  std::vector<double> values;
  for (const MemberPath* const path : Spread(paths)) {
    if (const auto loop = path->At(points, phi)) values.push_back(MapValue(*loop, parameter));
  }
  return Summarise(std::move(values));
}

}  // namespace howl
