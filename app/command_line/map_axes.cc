#include "app/command_line/map_axes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "app/command_line/asked_points.h"

namespace howl {
namespace {

constexpr std::size_t kMostOfAnAxis = 400;
constexpr int kDefaultSteps = 40;

MapQuantity ParseQuantity(const Config& config, const std::string& text, const std::string& name) {
  if (name == "phi" || name == config.operating_parameter) return MapQuantity::kOperatingPoint;
  std::string expected = config.operating_parameter;
  for (const MapQuantity parameter : kMapParameters) {
    if (parameter == MapQuantity::kM && config.model.modes == 1) continue;
    if (name == MapQuantityName(parameter)) return parameter;
    expected += ", " + std::string(MapQuantityName(parameter));
  }
  throw UsageError("--map: " + text + ", expected two of " + expected +
                   ", joined by a colon, such as " + config.operating_parameter + ":tau_s");
}

void ReadRange(const Options& options, const std::string& option, MapAxis& axis) {
  const std::optional<std::string> text = options.Text(option);
  if (!text) return;
  axis.values = ParseAskedPoints(option, *text, kMostOfAnAxis);
  const bool ascending =
      std::ranges::adjacent_find(axis.values, std::greater_equal<>()) == axis.values.end();
  if (axis.values.size() < 2 || !ascending) {
    throw UsageError(option + ": " + *text + ", expected FROM:TO:STEP with two values or more");
  }
  const std::string name(MapQuantityName(axis.quantity));
  if (axis.quantity == MapQuantity::kFlameSlope) {
    if (axis.values.back() >= 0.0) throw UsageError(option + ": " + name + " is below zero");
  } else if (axis.quantity == MapQuantity::kM) {
    if (axis.values.front() < 0.0) throw UsageError(option + ": " + name + " is not below zero");
  } else if (axis.quantity != MapQuantity::kOperatingPoint && axis.values.front() <= 0.0) {
    throw UsageError(option + ": " + name + " is above zero");
  }
}

std::vector<double> Steps(double from, double to) {
  std::vector<double> values;
  for (int k = 0; k <= kDefaultSteps; ++k) {
    values.push_back(from + (to - from) * k / kDefaultSteps);
  }
  return values;
}

void FillRange(const OperatingPoints& points, std::span<const MemberPath> paths,
               const std::vector<double>& phi, MapAxis& axis) {
  if (!axis.values.empty()) return;
  if (axis.quantity == MapQuantity::kOperatingPoint) {
    axis.values = Steps(points.phi(0), points.phi(points.size() - 1));
    return;
  }
  double lo = HUGE_VAL, hi = -HUGE_VAL;
  for (const double each : phi) {
    const SampledValue value = MapValuesAt(points, paths, axis.quantity, each);
    if (!std::isfinite(value.median)) continue;
    lo = std::min(lo, value.lo);
    hi = std::max(hi, value.hi);
  }
  constexpr double kLess = 0.5, kMore = 1.5;
  if (lo > hi || (lo == 0.0 && hi == 0.0)) {
    throw UsageError("--map: the members have no " + std::string(MapQuantityName(axis.quantity)) +
                     " there, expected its range, --map-x or --map-y FROM:TO:STEP");
  }
  axis.values = hi < 0.0 ? Steps(kMore * lo, kLess * hi) : Steps(kLess * lo, kMore * hi);
}

}  // namespace

bool AskedMap::HasOperatingAxis() const {
  return x.quantity == MapQuantity::kOperatingPoint || y.quantity == MapQuantity::kOperatingPoint;
}

std::optional<AskedMap> ParseMap(const Config& config, const Options& options) {
  const std::optional<std::string> text = options.Text("--map");
  if (!text) {
    for (const char* const option : {"--map-x", "--map-y"}) {
      if (options.Has(option)) throw UsageError(std::string(option) + ": expected --map with it");
    }
    return std::nullopt;
  }
  const std::size_t colon = text->find(':');
  AskedMap map;
  map.x.quantity = ParseQuantity(config, *text, text->substr(0, colon));
  map.y.quantity =
      ParseQuantity(config, *text, colon == std::string::npos ? "" : text->substr(colon + 1));
  if (map.x.quantity == map.y.quantity) {
    throw UsageError("--map: " + *text + ", expected two different quantities");
  }
  ReadRange(options, "--map-x", map.x);
  ReadRange(options, "--map-y", map.y);
  return map;
}

void FillRanges(const OperatingPoints& points, std::span<const MemberPath> paths,
                const std::vector<double>& phi, AskedMap& map) {
  FillRange(points, paths, phi, map.x);
  FillRange(points, paths, phi, map.y);
}

}  // namespace howl
