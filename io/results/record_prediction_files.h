// What `howl predict` writes of loops that were fitted to whole records: prediction.csv and
// prediction.json (schema howl.prediction/1) as family/predict_files.h has them, with these
// differences. Values are medians and lo .. hi holds 95 % of the density that the records give
// (loop_prediction.h); there are no members and no paths, no interval is guaranteed, and
// p_amplitude has no value: their cells are empty. share_unstable is a probability.
#ifndef HOWL_IO_RESULTS_RECORD_PREDICTION_FILES_H_
#define HOWL_IO_RESULTS_RECORD_PREDICTION_FILES_H_

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "estimation/joint_records/loop_prediction.h"

namespace howl {

struct RecordPredictionPoint {
  double operating_parameter = 0.0;
  std::string kind;         // "measured", "between", "beyond", "outside"
  std::string experiment;   // that was measured there; empty: none
  RestLoopPrediction loop;  // without values at "outside"
};

struct RecordPrediction {
  std::string operating_parameter;
  std::size_t measured_points = 0;
  std::vector<RecordPredictionPoint> points;
};

std::string RecordPredictionCsv(const RecordPrediction& prediction);
nlohmann::ordered_json RecordPredictionJson(const RecordPrediction& prediction);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_RECORD_PREDICTION_FILES_H_
