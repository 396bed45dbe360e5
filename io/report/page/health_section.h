// The page's first section: the findings that speak against the numbers below it.
#ifndef HOWL_IO_REPORT_PAGE_HEALTH_SECTION_H_
#define HOWL_IO_REPORT_PAGE_HEALTH_SECTION_H_

#include <string>

#include "io/report/report_input.h"

namespace howl {

// The findings of analysis.json and solution.json, each once; empty where neither has any.
std::string HealthHtml(const ReportInput& input);

}  // namespace howl

#endif  // HOWL_IO_REPORT_PAGE_HEALTH_SECTION_H_
