#include "io/results/record_prediction_files.h"

#include <limits>

#include "io/results/csv_writer.h"
#include "io/results/solution_json.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Json IntervalJson(const PredictedValue& value) {
  return {{"value", NumberOrNull(value.value)},
          {"lo", NumberOrNull(value.lo)},
          {"hi", NumberOrNull(value.hi)}};
}

}  // namespace

std::string RecordPredictionCsv(const RecordPrediction& prediction) {
  const OwnNameColumn own(prediction.operating_parameter);
  CsvWriter csv("phi,quantity,value,lo,hi,guaranteed_lo,guaranteed_hi" + own.Header());
  for (const RecordPredictionPoint& point : prediction.points) {
    const auto row = [&](const char* name, const PredictedValue& value) {
      csv.Cell(point.operating_parameter).Cell(name).Cell(value.value).Cell(value.lo);
      csv.Cell(value.hi).Cell(kNone).Cell(kNone);
      own.Add(csv, point.operating_parameter).EndRow();
    };
    row("frequency_hz", point.loop.frequency_hz);
    row("growth_rate_1_s", point.loop.growth_rate_1_s);
    row("loop_gain", point.loop.loop_gain);
    row("p_amplitude", {kNone, kNone, kNone});
    row("share_unstable", {point.loop.share_unstable, kNone, kNone});
  }
  return csv.Text();
}

Json RecordPredictionJson(const RecordPrediction& prediction) {
  Json points = Json::array();
  for (const RecordPredictionPoint& point : prediction.points) {
    points.push_back(
        {{"phi", point.operating_parameter},
         {"status", point.kind},
         {"experiment", point.experiment.empty() ? Json(nullptr) : Json(point.experiment)},
         {"next_to_unreliable", false},
         {"paths", 0},
         {"paths_without_loop", 0},
         {"frequency_hz", IntervalJson(point.loop.frequency_hz)},
         {"growth_rate_1_s", IntervalJson(point.loop.growth_rate_1_s)},
         {"loop_gain", IntervalJson(point.loop.loop_gain)},
         {"p_amplitude", IntervalJson({kNone, kNone, kNone})},
         {"share_unstable", NumberOrNull(point.loop.share_unstable)},
         {"guaranteed", nullptr}});
  }
  return {{"schema", "howl.prediction/1"},
          {"operating_parameter", prediction.operating_parameter},
          {"members", 0},
          {"paths", 0},
          {"interval", "95 % of the density that the records give"},
          {"flame", "measured"},
          {"scatter_known", prediction.measured_points > 2},
          {"points", points},
          {"cycle", nullptr}};
}

}  // namespace howl
