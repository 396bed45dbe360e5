// A table for the terminal: columns as wide as they need, numbers to the right, lines of at most
// kTerminalColumns characters.
#ifndef HOWL_APP_TEXT_TEXT_TABLE_H_
#define HOWL_APP_TEXT_TEXT_TABLE_H_

#include <cstddef>
#include <string>
#include <vector>

namespace howl {

inline constexpr std::size_t kTerminalColumns = 100;

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}

  void AddRow(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  // Lines end with a newline; the first column is flush left, the others flush right. A table that
  // is too wide goes on below with the columns that are left, its first column repeated. The header
  // stands out on a terminal that shows colours.
  std::string Text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

// The legend of every table and line that has a ±.
inline constexpr const char* kPlusMinusLegend = "±: half of a 95 % interval";

// `digits` significant digits, no exponent where it can be avoided; "-" for NaN.
std::string Significant(double value, int digits = 5);
// Fixed number of decimals; "-" for NaN.
std::string Fixed(double value, int decimals);

// Characters that a terminal shows: UTF-8 counts its code points.
std::size_t DisplayWidth(const std::string& text);
// Broken between words into lines of at most kTerminalColumns, each but the first indented.
std::string Wrapped(const std::string& text, std::size_t indent);
// "a, b, c"
std::string CommaSeparated(const std::vector<std::string>& names);
// Emphasis, where standard output is a terminal and NO_COLOR is not set.
std::string Bold(const std::string& text);

}  // namespace howl

#endif  // HOWL_APP_TEXT_TEXT_TABLE_H_
