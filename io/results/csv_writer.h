// Comma-separated values: numbers at full precision, an empty cell where one is not finite.
#ifndef HOWL_IO_RESULTS_CSV_WRITER_H_
#define HOWL_IO_RESULTS_CSV_WRITER_H_

#include <string>
#include <string_view>

namespace howl {

class CsvWriter {
 public:
  explicit CsvWriter(std::string_view header) : text_(header) { text_ += '\n'; }

  CsvWriter& Cell(std::string_view text);
  CsvWriter& Cell(double value);
  void EndRow();
  const std::string& Text() const { return text_; }

 private:
  std::string text_;
  bool row_is_empty_ = true;
};

}  // namespace howl

#endif  // HOWL_IO_RESULTS_CSV_WRITER_H_
