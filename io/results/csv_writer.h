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

// The operating parameter stands in the column `phi` whatever the config calls it, so that scripts
// find it; one with a name of its own stands under that name too, in the last column.
class OwnNameColumn {
 public:
  explicit OwnNameColumn(std::string_view operating_parameter) : name_(operating_parameter) {}

  // ",air_slpm" behind a header; empty for phi itself.
  std::string Header() const { return exists() ? "," + name_ : std::string(); }
  // Behind the other cells of a row.
  CsvWriter& Add(CsvWriter& csv, double phi) const { return exists() ? csv.Cell(phi) : csv; }

 private:
  bool exists() const { return name_ != "phi"; }

  std::string name_;
};

}  // namespace howl

#endif  // HOWL_IO_RESULTS_CSV_WRITER_H_
