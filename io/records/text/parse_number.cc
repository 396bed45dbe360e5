#include "io/records/text/parse_number.h"

#include <cstdlib>
#include <string>

namespace howl {

std::string_view Trim(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\f\v";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view Unquote(std::string_view text) {
  text = Trim(text);
  if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') &&
      text.back() == text.front()) {
    text = Trim(text.substr(1, text.size() - 2));
  }
  return text;
}

std::optional<double> ParseField(std::string_view field) {
  std::string text(Unquote(field));
  if (text.starts_with('+') && !text.starts_with("+-")) text.erase(0, 1);
  const bool word = text.find_first_of("nN") != std::string::npos;  // nan, inf
  const std::size_t fortran = word ? std::string::npos : text.find_first_of("dD");
  if (fortran != std::string::npos) text[fortran] = 'e';
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || stop != end || error == std::errc::invalid_argument) return std::nullopt;
  // from_chars leaves the value alone here; strtod tells overflow (inf) from underflow (0). The
  // program never leaves the C locale.
  if (error == std::errc::result_out_of_range) return std::strtod(text.c_str(), nullptr);
  return value;
}

}  // namespace howl
