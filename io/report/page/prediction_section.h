// The text of the page's section about operating points that were not measured.
#ifndef HOWL_IO_REPORT_PAGE_PREDICTION_SECTION_H_
#define HOWL_IO_REPORT_PAGE_PREDICTION_SECTION_H_

#include <string>

#include "io/report/report_input.h"

namespace howl {

// A table of the predicted points; empty where howl predict has not run.
std::string PredictionSummary(const ReportInput& input);

}  // namespace howl

#endif  // HOWL_IO_REPORT_PAGE_PREDICTION_SECTION_H_
