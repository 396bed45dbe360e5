#include "io/records/text/text_layout.h"

#include <algorithm>

#include "io/records/columns/table_source.h"
#include "io/records/text/parse_number.h"

namespace howl {
namespace {

std::string WithoutQuoted(std::string_view line) {
  std::string bare;
  bool inside = false;
  for (const char c : line) {
    inside = inside != (c == '"');
    if (!inside) bare += c;
  }
  return bare;
}

// A tab counts when it parts fields that are there; else it only aligns them.
char FindSeparator(std::string_view quoted_line, bool decimal_comma) {
  const std::string bare = WithoutQuoted(quoted_line);
  const std::string_view line = bare;
  if (line.find(';') != std::string_view::npos) return ';';
  const std::string_view text = Trim(line);
  if (!line.starts_with('\t') && text.find('\t') != std::string_view::npos &&
      text.find("\t\t") == std::string_view::npos) {
    return '\t';
  }
  return !decimal_comma && line.find(',') != std::string_view::npos ? ',' : kWhiteSpace;
}

bool IsEmpty(std::string_view field) { return Trim(field).empty(); }

// A separator inside of quotes belongs to the field ("Pressure, Pa").
std::size_t FieldEnd(std::string_view line, std::size_t begin, std::string_view separators) {
  const std::size_t first = line.find_first_not_of(' ', begin);
  if (first != std::string_view::npos && line[first] == '"') {
    const std::size_t closing = line.find('"', first + 1);
    if (closing != std::string_view::npos) begin = closing;
  }
  return line.find_first_of(separators, begin);
}

std::vector<std::string> Texts(const std::vector<std::string_view>& fields) {
  std::vector<std::string> texts;
  texts.reserve(fields.size());
  for (const std::string_view field : fields) texts.emplace_back(Unquote(field));
  return texts;
}

void DropTrailingEmpty(std::vector<std::string_view>& fields) {
  if (fields.size() > 1 && IsEmpty(fields.back())) fields.pop_back();
}

std::vector<std::string> Names(std::vector<std::string_view> fields) {
  DropTrailingEmpty(fields);
  return Texts(fields);
}

}  // namespace

bool IsComment(std::string_view line) {
  const std::string_view text = Trim(line);
  return !text.empty() && (text.front() == '#' || text.front() == '%');
}

std::vector<std::string_view> SplitFields(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  if (separator == kWhiteSpace) {
    for (std::string_view rest = Trim(line); !rest.empty(); rest = Trim(rest)) {
      const std::size_t length = std::min(FieldEnd(rest, 0, " \t"), rest.size());
      fields.push_back(rest.substr(0, length));
      rest.remove_prefix(length);
    }
    return fields;
  }
  for (std::size_t begin = 0;;) {
    const std::size_t end = FieldEnd(line, begin, std::string_view(&separator, 1));
    fields.push_back(line.substr(begin, end - begin));
    if (end == std::string_view::npos) return fields;
    begin = end + 1;
  }
}

bool TextLayout::IsNumber(std::string_view field) const {
  if (!decimal_comma) return ParseField(field).has_value();
  std::string text(field);
  std::ranges::replace(text, ',', '.');
  return ParseField(text).has_value();
}

// A line with numbers is a row, unless a word stands before plain integers: channels may be named
// by number ("time,1,2"), while a typing error in a first row ("1,abc") must not pass as names.
bool TextLayout::IsHeader(const std::vector<std::string_view>& fields) const {
  const auto is_name = [this](std::string_view field) {
    return !IsNumber(field) || ColumnNumber(std::string(Unquote(field))) > 0;
  };
  return !IsEmpty(fields.front()) && !IsNumber(fields.front()) &&
         std::all_of(fields.begin(), fields.end(), is_name);
}

// A column without a unit may have an empty place, but not all of them.
bool TextLayout::IsUnitsLine(const std::vector<std::string_view>& fields) const {
  return std::ranges::none_of(fields, [this](std::string_view field) { return IsNumber(field); }) &&
         !std::ranges::all_of(fields, IsEmpty);
}

bool TextLayout::TakeLine(std::string_view line) {
  if (IsEmpty(line)) return false;
  if (IsComment(line)) {
    const std::string_view text = Trim(line);
    last_comment = text.substr(std::min(text.find_first_not_of("#% \t"), text.size()));
    return false;
  }
  if (names.empty() && first_row.empty()) {
    if (separator == '\0') separator = FindSeparator(line, decimal_comma);
    const std::vector<std::string_view> fields = SplitFields(line, separator);
    if (IsHeader(fields)) {
      names = Names(fields);
      if (has_comments && names.back() == "Comment") names.pop_back();
      // A header of one name with blanks in it, and nothing to part it from others.
      if (separator == kWhiteSpace) last_comment = Trim(line);
      return false;
    }
  }
  std::vector<std::string_view> fields = SplitFields(line, separator);
  if (fields.size() == names.size() + 1) DropTrailingEmpty(fields);
  if (!names.empty() && units.empty() && fields.size() == names.size() && IsUnitsLine(fields)) {
    units = Texts(fields);
    return false;
  }
  TakeFirstRow(fields);
  return true;
}

void TextLayout::TakeFirstRow(const std::vector<std::string_view>& fields) {
  std::vector<std::string_view> values = fields;
  if (fields.size() != names.size()) DropTrailingEmpty(values);
  columns = values.size();
  first_row = Texts(values);
  if (columns == 1 && separator == kWhiteSpace && names.size() > 1) names = {last_comment};
  if (names.empty() && !last_comment.empty()) {
    for (const char candidate :
         {separator, FindSeparator(last_comment, decimal_comma), kWhiteSpace}) {
      const std::vector<std::string> found = Names(SplitFields(last_comment, candidate));
      if (found.size() == columns) {
        names = found;
        break;
      }
    }
  }
  if (!names.empty()) columns = names.size();
}

}  // namespace howl
