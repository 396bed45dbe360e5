// What `howl predict` writes.
//
// prediction.csv, one row for each operating point and quantity:
//
//   phi,quantity,value,lo,hi,guaranteed_lo,guaranteed_hi
//
// value is the median of the members, lo .. hi holds 95 % of them; a guaranteed interval stands at
// measured points alone. Quantities: frequency_hz, growth_rate_1_s, loop_gain, p_amplitude (or
// q_amplitude_relative, over the flame's saturation, where its shape is assumed), share_unstable.
// Cells are empty where there is no value. A parameter of another name than phi stands under its
// own name too, in the last column.
//
// prediction.json, schema howl.prediction/1: the same, and where the cycle begins and ends.
#ifndef HOWL_IO_RESULTS_FAMILY_PREDICT_FILES_H_
#define HOWL_IO_RESULTS_FAMILY_PREDICT_FILES_H_

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "estimation/family/answers/predict/predict_points.h"
#include "estimation/family/problem/family_parameter.h"

namespace howl {

// What no member violates at a measured point.
struct GuaranteedPoint {
  std::string experiment;
  std::optional<Range> frequency_hz;  // one mode
  std::vector<std::pair<FamilyParameter, Range>> parameters;
};

struct PredictReport {
  std::string operating_parameter;
  std::size_t members = 0;
  std::size_t paths = 0;      // draws over all members
  std::string flame;          // "measured", "config" or "assumed"
  bool scatter_known = true;  // three operating points or more
  std::vector<PointPrediction> points;
  std::vector<std::optional<GuaranteedPoint>> guaranteed;  // one for each point
  std::optional<CycleLimits> cycle;
};

std::string PointKindName(PointKind kind);  // "measured", "between", "beyond", "outside"
std::string AmplitudeName(const PredictReport& report);

std::string PredictCsv(const PredictReport& report);
nlohmann::ordered_json PredictJson(const PredictReport& report);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_FAMILY_PREDICT_FILES_H_
