#include "io/results/family/stability_map_files.h"

#include <algorithm>
#include <cmath>

#include "io/result_files.h"
#include "io/results/csv_writer.h"
#include "io/results/family/sampled_value_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

Json AxisJson(const MapAxis& axis) {
  return {{"quantity", std::string(MapQuantityName(axis.quantity))},
          {"from", axis.values.front()},
          {"to", axis.values.back()},
          {"values", axis.values.size()}};
}

double PhiOf(const MapReport& report, double x, double y) {
  if (report.map.x.quantity == MapQuantity::kOperatingPoint) return x;
  return report.map.y.quantity == MapQuantity::kOperatingPoint ? y : report.phi;
}

}  // namespace

std::string StabilityMapCsv(const MapReport& report) {
  const StabilityMap& map = report.map;
  const OwnNameColumn own(report.operating_parameter);
  CsvWriter csv(std::string(MapQuantityName(map.x.quantity)) + "," +
                std::string(MapQuantityName(map.y.quantity)) +
                ",growth_rate_1_s,lo,hi,share_unstable,members" + own.Header());
  for (std::size_t j = 0; j < map.y.values.size(); ++j) {
    for (std::size_t i = 0; i < map.x.values.size(); ++i) {
      const MapCell& cell = map.At(i, j);
      csv.Cell(map.x.values[i]).Cell(map.y.values[j]).Cell(cell.growth_rate.median);
      csv.Cell(cell.growth_rate.lo).Cell(cell.growth_rate.hi).Cell(cell.share_unstable);
      csv.Cell(static_cast<double>(cell.members));
      own.Add(csv, PhiOf(report, map.x.values[i], map.y.values[j])).EndRow();
    }
  }
  return csv.Text();
}

Json StabilityMapJson(const MapReport& report) {
  Json marks = Json::array();
  for (const MapMark& mark : report.marks) {
    marks.push_back(
        {{"phi", mark.phi}, {"x", SampledValueJson(mark.x)}, {"y", SampledValueJson(mark.y)}});
  }
  const auto count = [&](auto&& test) { return std::ranges::count_if(report.map.cells, test); };
  return {{"file", kPredictionMapCsv},
          {"x", AxisJson(report.map.x)},
          {"y", AxisJson(report.map.y)},
          {"phi", NumberOrNull(report.phi)},
          {"paths", report.map.paths},
          {"interval", "95 % of the members"},
          {"points", report.map.cells.size()},
          // Of the points: where 97.5 % of the members grow, and where as many decay.
          {"unstable", count(&MapCell::Grows)},
          {"stable", count(&MapCell::Decays)},
          {"members", marks}};
}

}  // namespace howl
