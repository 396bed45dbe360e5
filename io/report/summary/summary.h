// What a report says first, in plain sentences from the files that are there: what was found, how
// sure it is, and what to do next.
#ifndef HOWL_IO_REPORT_SUMMARY_SUMMARY_H_
#define HOWL_IO_REPORT_SUMMARY_SUMMARY_H_

#include <string>
#include <vector>

#include "io/report/report_input.h"

namespace howl {

// Text, not HTML: names in it come from configs and records.
std::vector<std::string> WhatWasFound(const ReportInput& input);
std::vector<std::string> HowSureItIs(const ReportInput& input);
std::vector<std::string> WhatToDoNext(const ReportInput& input);

// The section; empty where there is nothing to say.
std::string SummaryHtml(const ReportInput& input);

}  // namespace howl

#endif  // HOWL_IO_REPORT_SUMMARY_SUMMARY_H_
