// Text of a report's page.
#ifndef HOWL_IO_REPORT_HTML_TEXT_H_
#define HOWL_IO_REPORT_HTML_TEXT_H_

#include <string>

namespace howl {

// & < > and quotes as entities.
std::string EscapeHtml(const std::string& text);

}  // namespace howl

#endif  // HOWL_IO_REPORT_HTML_TEXT_H_
