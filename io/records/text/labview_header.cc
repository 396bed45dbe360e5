#include "io/records/text/labview_header.h"

#include <algorithm>
#include <string>

#include "io/records/text/parse_number.h"

namespace howl {
namespace {

constexpr std::string_view kEnd = "***End_of_Header***";

// The text that follows the key, up to the line's end; no value for another key.
std::optional<std::string_view> ValueOf(std::string_view line, std::string_view key) {
  if (!line.starts_with(key) || line.size() == key.size()) return std::nullopt;
  const std::string_view rest = line.substr(key.size());
  if (std::string_view("\t,; ").find(rest.front()) == std::string_view::npos) return std::nullopt;
  return rest.substr(1);
}

void TakeLine(std::string_view line, LabviewHeader& header) {
  if (const auto value = ValueOf(line, "Separator")) {
    header.separator = Trim(*value) == "Comma" ? ',' : '\t';
  }
  if (const auto value = ValueOf(line, "Decimal_Separator")) {
    header.decimal_comma = Trim(*value).starts_with(',');
  }
  if (const auto value = ValueOf(line, "Delta_X")) {
    const std::string_view first = value->substr(0, value->find(header.separator));
    std::string text(Trim(first));
    std::ranges::replace(text, ',', '.');
    const std::optional<double> step = ParseField(text);
    if (step && *step > 0.0) header.step_s = step;
  }
}

}  // namespace

std::optional<LabviewHeader> ReadLabviewHeader(std::string_view start) {
  LabviewHeader header;
  int line_number = 0;
  for (std::size_t begin = 0; begin < start.size();) {
    const std::size_t end = std::min(start.find('\n', begin), start.size());
    const std::string_view line = start.substr(begin, end - begin);
    ++line_number;
    if (line.starts_with(kEnd)) header.lines = line_number;
    TakeLine(line, header);
    begin = end + 1;
  }
  if (header.lines == 0) return std::nullopt;
  return header;
}

}  // namespace howl
