#include "io/records/text/text_dialect.h"

#include <algorithm>
#include <vector>

#include "io/records/text/parse_number.h"
#include "io/records/text/text_layout.h"

namespace howl {
namespace {

constexpr int kMostSkipped = 60;  // longer preambles are none that a person wrote
constexpr std::size_t kFewestRows = 3;
constexpr std::size_t kRowsLooked = 20;
// Each candidate splits the lines anew, and there are hundreds of candidates.
constexpr std::size_t kBytesLooked = std::size_t{1} << 17;

std::span<const std::string_view> Looked(std::span<const std::string_view> lines) {
  std::size_t bytes = 0;
  std::size_t count = 0;
  while (count < lines.size() && bytes + lines[count].size() <= kBytesLooked) {
    bytes += lines[count++].size();
  }
  return lines.first(count);
}

// `at`: the first row of the data.
TextLayout LayoutOf(std::span<const std::string_view> lines, const TextDialect& dialect,
                    std::size_t& at) {
  TextLayout layout;
  layout.decimal_comma = dialect.decimal_comma;
  at = static_cast<std::size_t>(dialect.skip_rows);
  while (at < lines.size() && !layout.TakeLine(lines[at])) ++at;
  return layout;
}

// Whether the rows behind the header have as many fields each, numbers or texts in the same places;
// `all_numbers`: numbers alone.
bool MakesTable(std::span<const std::string_view> lines, const TextDialect& dialect,
                const TextLayout& as_stated, bool all_numbers) {
  std::size_t at = 0;
  const TextLayout layout = LayoutOf(lines, dialect, at);
  // The rows that would be skipped are the table's own header and a damaged row below it.
  const bool has_header = layout.names.empty() && as_stated.names.size() == layout.columns;
  if (has_header && as_stated.separator == layout.separator) return false;
  std::vector<bool> is_number;
  std::size_t rows = 0;
  for (; at < lines.size() && rows < kRowsLooked; ++at) {
    if (IsComment(lines[at])) continue;
    std::vector<std::string_view> fields = SplitFields(lines[at], layout.separator);
    if (fields.size() == layout.columns + 1 && Trim(fields.back()).empty()) fields.pop_back();
    if (fields.size() != layout.columns) return false;
    std::vector<bool> numbers;
    for (const std::string_view field : fields) numbers.push_back(layout.IsNumber(field));
    if (rows == 0) is_number = numbers;
    if (numbers != is_number) return false;
    ++rows;
  }
  const auto count = std::count(is_number.begin(), is_number.end(), true);
  return rows >= kFewestRows && count > 0 &&
         (!all_numbers || static_cast<std::size_t>(count) == is_number.size());
}

}  // namespace

std::optional<TextDialect> GuessDialect(std::span<const std::string_view> all,
                                        const TextDialect& stated) {
  const std::span<const std::string_view> lines = Looked(all);
  std::vector<TextDialect> candidates = {stated, {stated.skip_rows, !stated.decimal_comma}};
  for (int skip_rows = 0; skip_rows <= kMostSkipped; ++skip_rows) {
    candidates.push_back({skip_rows, stated.decimal_comma});
    candidates.push_back({skip_rows, !stated.decimal_comma});
  }
  std::size_t first_row = 0;
  const TextLayout as_stated = LayoutOf(lines, stated, first_row);
  for (const bool all_numbers : {true, false}) {
    for (const TextDialect& candidate : candidates) {
      if (MakesTable(lines, candidate, as_stated, all_numbers)) return candidate;
    }
  }
  return std::nullopt;
}

std::string DialectHint(std::span<const std::string_view> lines, const TextDialect& stated) {
  const std::optional<TextDialect> better = GuessDialect(lines, stated);
  if (!better || *better == stated) return "";
  std::string look;
  std::string keys;
  if (better->skip_rows != stated.skip_rows) {
    look = "from line " + std::to_string(better->skip_rows + 1) + " on it looks like a table";
    keys = "skip_rows: " + std::to_string(better->skip_rows);
  }
  if (better->decimal_comma != stated.decimal_comma) {
    look += (look.empty() ? "the rows look like numbers" : "") +
            std::string(better->decimal_comma ? " with a decimal comma" : " with a decimal point");
    if (!keys.empty()) keys += " and ";
    keys += better->decimal_comma ? "decimal: \",\"" : "decimal: \".\"";
  }
  return "; " + look + ": " + keys + " in the record";
}

}  // namespace howl
