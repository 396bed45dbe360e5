// A table of the page.
#ifndef HOWL_IO_REPORT_HTML_TABLE_H_
#define HOWL_IO_REPORT_HTML_TABLE_H_

#include <string>
#include <vector>

namespace howl {

// Cells are text, and become HTML here; the caption is HTML. The first cell of a row is its name.
std::string HtmlTable(const std::string& caption, const std::vector<std::string>& head,
                      const std::vector<std::vector<std::string>>& rows);

}  // namespace howl

#endif  // HOWL_IO_REPORT_HTML_TABLE_H_
