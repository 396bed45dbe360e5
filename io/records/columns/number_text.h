// Numbers in the form that messages show.
#ifndef HOWL_IO_RECORDS_COLUMNS_NUMBER_TEXT_H_
#define HOWL_IO_RECORDS_COLUMNS_NUMBER_TEXT_H_

#include <charconv>
#include <cstdlib>
#include <string>

namespace howl {

inline std::string NumberText(double value, int digits) {
  char text[64];
  const auto [end, error] =
      std::to_chars(text, text + sizeof(text), value, std::chars_format::general, digits);
  return std::string(text, end);
}

// The shortest text that reads back as the same double.
inline std::string NumberText(double value) {
  char text[64];
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value);
  return std::string(text, end);
}

// The value rounded to so many digits; of a value at an end of the range, which std::stod refuses,
// infinity or what is left of it.
inline double RoundedTo(double value, int digits) {
  return std::strtod(NumberText(value, digits).c_str(), nullptr);
}

}  // namespace howl

#endif  // HOWL_IO_RECORDS_COLUMNS_NUMBER_TEXT_H_
