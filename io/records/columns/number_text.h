// Numbers in the form that messages show.
#ifndef HOWL_IO_RECORDS_COLUMNS_NUMBER_TEXT_H_
#define HOWL_IO_RECORDS_COLUMNS_NUMBER_TEXT_H_

#include <charconv>
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

}  // namespace howl

#endif  // HOWL_IO_RECORDS_COLUMNS_NUMBER_TEXT_H_
