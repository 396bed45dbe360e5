// Parses the rows of a text table into columns of doubles: the reader's hot loop.
#ifndef HOWL_IO_RECORDS_TEXT_TEXT_ROWS_H_
#define HOWL_IO_RECORDS_TEXT_TEXT_ROWS_H_

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/records/columns/table_source.h"
#include "io/records/text/text_layout.h"

namespace howl {

class TextRows {
 public:
  // `wanted`: the file's columns (from 0) in the order asked for, all different. `hint` is added to
  // what is said of a row that is none.
  TextRows(std::string file, TextLayout layout, const std::vector<std::size_t>& wanted,
           std::vector<std::string> display_names, std::string hint);

  // Whole lines; `first_line` is the number of the first. `fraction` of the file lies behind the
  // end of them. Returns the number of lines. Throws UserError.
  int TakeBlock(const char* begin, const char* end, int first_line, double fraction);

  Columns TakeColumns() { return std::move(columns_); }
  int LineOf(std::size_t row) const;

 private:
  template <bool kBlanksSeparate>
  const char* TakeRow(const char* s, const char* end);
  template <bool kBlanksSeparate>
  int TakeLines(const char* begin, const char* end, int first_line);
  void TakeUnusualLine(std::string_view line, int number);
  void MakeRoom(std::size_t bytes, double fraction);
  void Commit();
  [[noreturn]] void Fail(int line, const std::string& key, const std::string& what) const;

  std::string file_;
  TextLayout layout_;
  std::vector<int> slot_of_;  // for each column of the file its place in `columns_`, or -1
  std::vector<std::string> display_names_;
  std::string hint_;
  Columns columns_;
  std::vector<double> row_;
  int blank_line_ = 0;  // a blank line among the data: no row may follow
  std::vector<std::pair<std::size_t, int>> line_of_row_;  // where the two go apart further
};

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TEXT_TEXT_ROWS_H_
