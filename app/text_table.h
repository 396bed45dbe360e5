// A table for the terminal: columns as wide as they need, numbers to the right.
#ifndef HOWL_APP_TEXT_TABLE_H_
#define HOWL_APP_TEXT_TABLE_H_

#include <string>
#include <vector>

namespace howl {

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}

  void AddRow(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  // Lines end with a newline; the first column is flush left, the others flush right.
  std::string Text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

// `digits` significant digits, no exponent where it can be avoided; "-" for NaN.
std::string Significant(double value, int digits = 5);
// Fixed number of decimals; "-" for NaN.
std::string Fixed(double value, int decimals);

}  // namespace howl

#endif  // HOWL_APP_TEXT_TABLE_H_
