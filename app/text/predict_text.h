// Prints the results of `howl predict` on the terminal.
#ifndef HOWL_APP_TEXT_PREDICT_TEXT_H_
#define HOWL_APP_TEXT_PREDICT_TEXT_H_

#include <string>

#include "io/results/family/predict_files.h"

namespace howl {

std::string PredictText(const PredictReport& report);

}  // namespace howl

#endif  // HOWL_APP_TEXT_PREDICT_TEXT_H_
