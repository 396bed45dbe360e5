#include "io/records/response_table.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/number_range.h"
#include "io/records/columns/number_text.h"
#include "io/records/open_table.h"
#include "io/user_error.h"

namespace howl {

InstrumentResponse ReadResponseTable(const std::filesystem::path& file) {
  const std::vector<ColumnName> names = {"frequency_hz", "magnitude", "phase_deg"};
  const std::unique_ptr<TableSource> table = OpenTable(file);
  Columns columns = table->Read(names);
  const std::size_t rows = columns.front().size();
  if (rows < 2) {
    throw UserError(file.string(), rows > 0 ? table->LineOf(0) : 0, "",
                    std::to_string(rows) + " rows, expected at least 2 of frequency_hz, " +
                        "magnitude and phase_deg");
  }
  for (std::size_t row = 0; row < rows; ++row) {
    const auto check = [&](std::size_t column, bool good, const std::string& expected) {
      if (good) return;
      const int line = table->LineOf(row);
      throw UserError(file.string(), line, names[column],
                      (line > 0 ? "" : "row " + std::to_string(row + 1) + ": ") +
                          NumberText(columns[column][row]) + ", expected " + expected);
    };
    for (std::size_t column = 0; column < names.size(); ++column) {
      const double value = columns[column][row];
      check(column, std::isfinite(value) && IsCarried(value),
            std::string("a finite number, 0 or of magnitude ") + kMagnitudeWords);
    }
    check(0, columns[0][row] >= 0.0, "a frequency of 0 Hz or more");
    check(1, columns[1][row] > 0.0, "a magnitude above 0");
    if (row > 0) {
      check(0, columns[0][row] > columns[0][row - 1],
            "frequencies that increase: more than the " + NumberText(columns[0][row - 1]) +
                " before it");
    }
  }
  return InstrumentResponse::OfTable(std::move(columns[0]), columns[1], columns[2]);
}

}  // namespace howl
