// What howl predict prints of loops that were fitted to records.
#ifndef HOWL_APP_TEXT_RECORD_PREDICT_TEXT_H_
#define HOWL_APP_TEXT_RECORD_PREDICT_TEXT_H_

#include <string>

#include "io/results/record_prediction_files.h"

namespace howl {

std::string RecordPredictText(const RecordPrediction& prediction);

}  // namespace howl

#endif  // HOWL_APP_TEXT_RECORD_PREDICT_TEXT_H_
