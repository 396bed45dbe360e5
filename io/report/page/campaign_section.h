// The page's section on a campaign: what was found over all its rigs.
#ifndef HOWL_IO_REPORT_PAGE_CAMPAIGN_SECTION_H_
#define HOWL_IO_REPORT_PAGE_CAMPAIGN_SECTION_H_

#include <string>

#include "io/report/report_input.h"

namespace howl {

// HTML; empty without a campaign.
std::string CampaignSummary(const ReportInput& input);

}  // namespace howl

#endif  // HOWL_IO_REPORT_PAGE_CAMPAIGN_SECTION_H_
