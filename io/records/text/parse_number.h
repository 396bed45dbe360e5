// Decimal text to the correctly rounded double (the nearest, ties to even), as strtod in the C
// locale gives it.
#ifndef HOWL_IO_RECORDS_TEXT_PARSE_NUMBER_H_
#define HOWL_IO_RECORDS_TEXT_PARSE_NUMBER_H_

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace howl {

inline constexpr std::array<double, 23> kExactPowersOfTen = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// The number that starts at `begin`, and where it ends; nullptr for what is unusual (words, out of
// range), which ParseField then judges. [begin, end) must hold a character, such as the line's end,
// that belongs to no number: the scan relies on it. Exact by Clinger's argument: a mantissa below
// 2^53 and a power of ten up to 10^22 are both doubles, so one division or product rounds once.
inline const char* ParseNumber(const char* begin, const char* end, double* value) {
  const char* s = begin;
  const bool negative = *s == '-';
  s += (*s == '-' || *s == '+') ? 1 : 0;
  const char* const unsigned_begin = s;
  const auto digit = [](char c) {
    return static_cast<unsigned>(static_cast<unsigned char>(c)) - 48U;
  };
  std::uint64_t mantissa = 0;
  while (digit(*s) < 10) mantissa = mantissa * 10 + digit(*s++);
  auto digits = s - unsigned_begin;
  int exponent = 0;
  if (*s == '.') {
    const char* const fraction = ++s;
    while (digit(*s) < 10) mantissa = mantissa * 10 + digit(*s++);
    digits += s - fraction;
    exponent = -static_cast<int>(s - fraction);
  }
  if (digits == 0) return nullptr;
  if ((*s | 0x20) == 'e') {
    ++s;
    const bool exponent_negative = *s == '-';
    s += (*s == '-' || *s == '+') ? 1 : 0;
    if (digit(*s) >= 10) return nullptr;
    int written = 0;
    while (digit(*s) < 10) {
      if (written < 100000) written = written * 10 + static_cast<int>(digit(*s));
      ++s;
    }
    exponent += exponent_negative ? -written : written;
  }
  constexpr std::uint64_t kExactMantissa = std::uint64_t{1} << 53;
  // 19 digits cannot overflow 64 bits.
  if (digits <= 19 && mantissa <= kExactMantissa && exponent >= -22 && exponent <= 22) {
    const double exact = static_cast<double>(mantissa);
    const double magnitude = exponent < 0
                                 ? exact / kExactPowersOfTen[static_cast<unsigned>(-exponent)]
                                 : exact * kExactPowersOfTen[static_cast<unsigned>(exponent)];
    *value = negative ? -magnitude : magnitude;
    return s;
  }
  double magnitude = 0.0;
  const auto [stop, error] = std::from_chars(unsigned_begin, end, magnitude);
  if (error != std::errc() || stop != s) return nullptr;
  *value = negative ? -magnitude : magnitude;
  return s;
}

// A whole field, blanks and quotes around it taken off: also nan, inf, Fortran's 1.5D+3 and numbers
// out of range (0 or inf). Nothing when it is no number.
std::optional<double> ParseField(std::string_view field);

// Without blanks at both ends.
std::string_view Trim(std::string_view text);

// Without blanks, then without a pair of quotes.
std::string_view Unquote(std::string_view text);

}  // namespace howl

#endif  // HOWL_IO_RECORDS_TEXT_PARSE_NUMBER_H_
