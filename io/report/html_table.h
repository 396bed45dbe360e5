// A table of a report's page.
#ifndef HOWL_IO_REPORT_HTML_TABLE_H_
#define HOWL_IO_REPORT_HTML_TABLE_H_

#include <string>
#include <utility>
#include <vector>

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

// What a reader sees, and the whole number, which is shown when the pointer rests on it.
struct TableCell {
  TableCell(std::string shown) : text(std::move(shown)) {}  // NOLINT: text is a cell
  TableCell(const char* shown) : text(shown) {}             // NOLINT
  // Three digits.
  explicit TableCell(double value, int digits = 3);
  // As many digits as its interval has; three where none is known. `scale` makes ms of s.
  explicit TableCell(const Estimate& estimate, double scale = 1.0);

  std::string text;
  std::string whole;  // empty: no more than what is shown
};
using TableRow = std::vector<TableCell>;

// Cells are text, and become HTML here; the caption is HTML. The first cell of a row is its name.
std::string HtmlTable(const std::string& caption, const std::vector<std::string>& head,
                      const std::vector<TableRow>& rows);

}  // namespace howl

#endif  // HOWL_IO_REPORT_HTML_TABLE_H_
