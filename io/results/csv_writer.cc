#include "io/results/csv_writer.h"

#include <array>
#include <charconv>
#include <cmath>

namespace howl {

CsvWriter& CsvWriter::Cell(std::string_view text) {
  if (!row_is_empty_) text_ += ',';
  text_ += text;
  row_is_empty_ = false;
  return *this;
}

CsvWriter& CsvWriter::Cell(double value) {
  if (!std::isfinite(value)) return Cell(std::string_view());
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return Cell(std::string_view(buffer.data(), end));
}

void CsvWriter::EndRow() {
  text_ += '\n';
  row_is_empty_ = true;
}

}  // namespace howl
