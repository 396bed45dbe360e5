// What howl fit prints of a loop that was fitted to records.
#ifndef HOWL_APP_TEXT_RECORD_FIT_TEXT_H_
#define HOWL_APP_TEXT_RECORD_FIT_TEXT_H_

#include <string>

#include "io/results/record_solution_json.h"

namespace howl {

std::string RecordFitText(const RecordSolution& solution, const std::string& operating_parameter);

}  // namespace howl

#endif  // HOWL_APP_TEXT_RECORD_FIT_TEXT_H_
