// Reads what was measured at each operating point, from the command that has it: analyse's own
// results, the config's table, or the characteristics that family and fit kept of the records.
#ifndef HOWL_IO_REPORT_READ_MEASURED_H_
#define HOWL_IO_REPORT_READ_MEASURED_H_

#include <vector>

#include "io/report/report_input.h"

namespace howl {

// The experiments are in the config's order; without a config, in that of the files. Experiments of
// which no command has results are left out. Needs config, analysis, solution and family of
// `input`.
std::vector<MeasuredPoint> ReadMeasured(const ReportInput& input);

}  // namespace howl

#endif  // HOWL_IO_REPORT_READ_MEASURED_H_
