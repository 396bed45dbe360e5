// The tables of the page: what was measured, fitted, bounded, diagnosed and tried.
#ifndef HOWL_IO_REPORT_PAGE_PAGE_TABLES_H_
#define HOWL_IO_REPORT_PAGE_PAGE_TABLES_H_

#include <string>

#include "io/report/report_input.h"

namespace howl {

// HTML; empty where there is nothing to tabulate.
std::string MeasuredTable(const ReportInput& input);
std::string FitTable(const ReportInput& input);
std::string FamilySummary(const ReportInput& input);
std::string DiagnosisSummary(const ReportInput& input);
std::string TrialSummary(const ReportInput& input);

}  // namespace howl

#endif  // HOWL_IO_REPORT_PAGE_PAGE_TABLES_H_
