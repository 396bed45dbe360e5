// The data of the page's family browser as JSON: experiments with their data, all members'
// parameters as base64 of 32-bit floats, a piece of each record. Curves are computed in the page
// from the model's equations, which keeps ten thousand members within a few megabytes.
#ifndef HOWL_IO_REPORT_PAGE_BROWSER_DATA_H_
#define HOWL_IO_REPORT_PAGE_BROWSER_DATA_H_

#include <nlohmann/json.hpp>
#include <string>

#include "io/report/report_input.h"

namespace howl {

// Null without members. Parameters: omega_hz, xi, N, M, tau_s of experiment 1, 2, ... of member 1,
// then of member 2, ...; little-endian.
nlohmann::ordered_json BrowserData(const ReportInput& input);

std::string Base64(const std::string& bytes);

}  // namespace howl

#endif  // HOWL_IO_REPORT_PAGE_BROWSER_DATA_H_
