// The page: report.html, one file that needs no other and no network.
#ifndef HOWL_IO_REPORT_PAGE_PAGE_H_
#define HOWL_IO_REPORT_PAGE_PAGE_H_

#include <map>
#include <string>
#include <vector>

#include "io/report/figure.h"
#include "io/report/report_input.h"

namespace howl {

// `svgs` by figure name; a figure without one is named with its caption alone.
std::string ReportPage(const ReportInput& input, const std::vector<Figure>& figures,
                       const std::map<std::string, std::string>& svgs);

}  // namespace howl

#endif  // HOWL_IO_REPORT_PAGE_PAGE_H_
