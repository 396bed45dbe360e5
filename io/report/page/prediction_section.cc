#include "io/report/page/prediction_section.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/report/html_table.h"
#include "io/report/script.h"

namespace howl {
namespace {

constexpr std::size_t kMostPredictions = 40;

// "205.8 (205.6 to 206.0)"
TableCell Interval(const nlohmann::json& point, const char* key) {
  const nlohmann::json& interval = JsonAt(point, key);
  const double value = NumberAt(interval, "value");
  if (!std::isfinite(value)) return "–";
  const double lo = NumberAt(interval, "lo"), hi = NumberAt(interval, "hi");
  TableCell cell(value);
  if (!std::isfinite(lo) || !std::isfinite(hi)) return cell;
  cell.text += " (" + Spelled(lo, 3) + " to " + Spelled(hi, 3) + ")";
  return cell;
}

}  // namespace

std::string PredictionSummary(const ReportInput& input) {
  const nlohmann::json& points = ListAt(input.prediction, "points");
  if (points.empty()) return {};
  const bool relative = TextAt(input.prediction, "flame") == "assumed";
  std::vector<TableRow> rows;
  for (const auto& point : points) {
    if (rows.size() == kMostPredictions) break;
    rows.push_back({Spelled(NumberAt(point, "phi"), 6), TextAt(point, "status"),
                    Interval(point, "frequency_hz"), Interval(point, "growth_rate_1_s"),
                    Interval(point, relative ? "q_amplitude_relative" : "p_amplitude"),
                    TableCell(100.0 * NumberAt(point, "share_unstable"))});
  }
  const std::string shown =
      rows.size() < points.size()
          ? "; the first " + std::to_string(rows.size()) + " of " + std::to_string(points.size())
          : std::string();
  // A loop that was fitted to whole records has no family.
  const bool of_records = NumberAt(input.prediction, "members") == 0.0;
  return HtmlTable(
      std::string(of_records ? "Median and the interval that holds 95 %; nothing is guaranteed"
                             : "Median of the members and the interval that holds 95 % of them; "
                               "guaranteed at measured points alone") +
          ". All is in prediction.csv" + shown,
      {input.OperatingLabel(), "", "f (Hz)", "growth rate (1/s)",
       relative ? "q over saturation" : "amplitude of p", "unstable (%)"},
      rows);
}

}  // namespace howl
