// UTF-8: what a config is, what JSON must be, and what a terminal shows.
#ifndef HOWL_IO_UTF8_TEXT_H_
#define HOWL_IO_UTF8_TEXT_H_

#include <cstddef>
#include <string>
#include <string_view>

namespace howl {

// The length of the character at the text's start; 0 where there is none, as in half a character,
// one that is written longer than need be, or half of a UTF-16 pair.
std::size_t Utf8Length(std::string_view text);

// The text with "?" for each byte that is of no character.
std::string AsUtf8Text(std::string_view text);

}  // namespace howl

#endif  // HOWL_IO_UTF8_TEXT_H_
