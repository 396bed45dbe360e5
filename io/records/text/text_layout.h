// The layout of a text table from its first lines: separator, names and number of the columns.
#ifndef HOWL_IO_RECORDS_TEXT_TEXT_LAYOUT_H_
#define HOWL_IO_RECORDS_TEXT_TEXT_LAYOUT_H_

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace howl {

inline constexpr char kWhiteSpace = ' ';  // the separator that stands for any run of blanks

struct TextLayout {
  char separator = '\0';           // '\0' until the first line that is no comment
  bool decimal_comma = false;      // given beforehand: a comma then parts no columns
  bool has_comments = false;       // given beforehand: behind the columns a row may have a remark
  std::vector<std::string> names;  // empty without a header
  std::vector<std::string> units;  // of a row below the header; empty without one
  std::vector<std::string> first_row;
  std::string last_comment;  // numpy and others write their header as a comment
  std::size_t columns = 0;   // 0 until the first row

  // Takes one of the lines before the data. True when it is the first row of the data.
  bool TakeLine(std::string_view line);
  // With this file's decimal sign.
  bool IsNumber(std::string_view field) const;

 private:
  bool IsHeader(const std::vector<std::string_view>& fields) const;
  bool IsUnitsLine(const std::vector<std::string_view>& fields) const;
  void TakeFirstRow(const std::vector<std::string_view>& fields);
};

bool IsComment(std::string_view line);

// The fields of a line, blanks at their ends kept; a trailing separator makes a last empty one,
// except among blanks.
std::vector<std::string_view> SplitFields(std::string_view line, char separator);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TEXT_TEXT_LAYOUT_H_
