#include "app/family/predict_map.h"

#include <algorithm>
#include <cmath>

#include "app/family/family_questions.h"
#include "app/text/text_table.h"

namespace howl {
namespace {

constexpr std::size_t kMostMembers = 1000;

std::string AxisText(const MapReport& report, const MapAxis& axis) {
  const std::string name = axis.quantity == MapQuantity::kOperatingPoint
                               ? report.operating_parameter
                               : std::string(MapQuantityName(axis.quantity));
  return name + " " + Significant(axis.values.front(), 4) + " .. " +
         Significant(axis.values.back(), 4);
}

}  // namespace

CarriedMembers CarryMembers(const Options& options, const FamilyRun& run) {
  const OperatingPoints points(run.problem.experiments);
  const std::vector<Member> members = Thinned(run.members, kMostMembers);
  return {points, members.size(),
          MakePaths(run.problem, points, members, options.seed, options.threads)};
}

MapReport MakeMap(const Config& config, const Options& options, const CarriedMembers& carried,
                  const std::vector<double>& asked, AskedMap map) {
  const OperatingPoints& points = carried.points;
  std::vector<double> marked = asked;
  if (map.HasOperatingAxis()) {
    marked.clear();
    for (std::size_t k = 0; k < points.size(); ++k) marked.push_back(points.phi(k));
  }
  FillRanges(points, carried.paths, marked, map);
  MapReport report{.operating_parameter = config.operating_parameter, .map = {}, .marks = {}};
  if (!map.HasOperatingAxis()) report.phi = asked.front();
  report.map = MakeStabilityMap(points, carried.paths, map.x, map.y, report.phi, options.threads);
  for (const double phi : marked) {
    const auto own = [&](const MapAxis& axis) {
      return axis.quantity == MapQuantity::kOperatingPoint
                 ? SampledValue{phi, phi, phi}
                 : MapValuesAt(points, carried.paths, axis.quantity, phi);
    };
    report.marks.push_back({phi, own(map.x), own(map.y)});
  }
  return report;
}

std::string MapText(const MapReport& report) {
  std::size_t unstable = 0, stable = 0, without = 0;
  for (const MapCell& cell : report.map.cells) {
    if (cell.members == 0) ++without;
    if (cell.Grows()) ++unstable;
    if (cell.Decays()) ++stable;
  }
  std::string text = "map: growth rate over " + AxisText(report, report.map.x) + " and " +
                     AxisText(report, report.map.y);
  if (std::isfinite(report.phi)) {
    text += " at " + report.operating_parameter + " " + Significant(report.phi, 4);
  }
  const std::size_t points = report.map.cells.size();
  text += ", " + std::to_string(points) + " points: " + std::to_string(unstable) + " grow and " +
          std::to_string(stable) + " decay for 97.5 % of the members, at " +
          std::to_string(points - unstable - stable - without) + " they differ";
  if (without > 0) text += ", " + std::to_string(without) + " are out of reach";
  return Wrapped(text, 2) + "\n";
}

}  // namespace howl
