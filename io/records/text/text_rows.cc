#include "io/records/text/text_rows.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <optional>

#include "io/memory.h"
#include "io/records/text/parse_number.h"
#include "io/user_error.h"

namespace howl {

TextRows::TextRows(std::string file, TextLayout layout, const std::vector<std::size_t>& wanted,
                   std::vector<std::string> display_names, std::string hint)
    : file_(std::move(file)),
      layout_(std::move(layout)),
      slot_of_(layout_.columns, -1),
      display_names_(std::move(display_names)),
      hint_(std::move(hint)),
      columns_(wanted.size()),
      row_(wanted.size()) {
  for (std::size_t i = 0; i < wanted.size(); ++i) slot_of_[wanted[i]] = static_cast<int>(i);
}

int TextRows::TakeBlock(const char* begin, const char* end, int first_line, double fraction) {
  if (line_of_row_.empty()) line_of_row_.emplace_back(0, first_line);
  MakeRoom(static_cast<std::size_t>(end - begin), fraction);
  return layout_.separator == kWhiteSpace ? TakeLines<true>(begin, end, first_line)
                                          : TakeLines<false>(begin, end, first_line);
}

// The hot loop allocates nothing: there is room for every row that the block can hold. Room that is
// never written costs no memory, so it is made for the whole file at once.
void TextRows::MakeRoom(std::size_t bytes, double fraction) {
  for (std::vector<double>& column : columns_) {
    const std::size_t most = column.size() + bytes / (2 * slot_of_.size()) + 1;
    if (most <= column.capacity()) continue;
    // The system grants more than there is, and ends the program that then uses it.
    const double needed = static_cast<double>(sizeof(double) * most * columns_.size());
    if (needed > MemoryBytes()) throw std::bad_alloc();
    std::size_t room = std::max(most, column.capacity() + column.capacity() / 2);
    if (fraction > 0.0 && !column.empty()) {
      // A start that is not like the rest (zeros in gzip) must not ask for the impossible.
      const double expected = 1.05 * static_cast<double>(column.size()) / fraction;
      const double trusted = std::min(expected, 16.0 * static_cast<double>(most));
      room = std::max(room, most + static_cast<std::size_t>(trusted));
    }
    column.reserve(room);
  }
}

inline void TextRows::Commit() {
  for (std::size_t i = 0; i < row_.size(); ++i) columns_[i].push_back(row_[i]);
}

// One usual row into `row_`; returns the start of the next line, or nullptr for a line to look at
// closely. `s` always ends at a line's end, so it needs no other bound.
template <bool kBlanksSeparate>
inline const char* TextRows::TakeRow(const char* s, const char* end) {
  const auto blank = [](char c) { return c == ' ' || (kBlanksSeparate && c == '\t'); };
  const char separator = layout_.separator;
  const std::size_t columns = slot_of_.size();
  for (std::size_t c = 0; c < columns; ++c) {
    while (blank(*s)) ++s;
    if (slot_of_[c] >= 0) {
      s = ParseNumber(s, end, &row_[static_cast<std::size_t>(slot_of_[c])]);
      if (s == nullptr) return nullptr;
    } else if (kBlanksSeparate) {
      if (*s == '\n' || *s == '\r' || *s == '#' || *s == '%') return nullptr;
      while (!blank(*s) && *s != '\n' && *s != '\r') ++s;
    } else {
      if (c == 0 && (*s == '\n' || *s == '\r' || *s == '#' || *s == '%')) return nullptr;
      while (*s != separator && *s != '\n') ++s;
    }
    if (c + 1 < columns) {
      if (kBlanksSeparate) {
        if (!blank(*s)) return nullptr;
      } else {
        while (blank(*s)) ++s;
        if (*s != separator) return nullptr;
        ++s;
      }
    }
  }
  while (blank(*s)) ++s;
  if (!kBlanksSeparate && *s == separator) ++s;
  while (blank(*s)) ++s;
  if (*s == '\r') ++s;
  return *s == '\n' ? s + 1 : nullptr;
}

template <bool kBlanksSeparate>
int TextRows::TakeLines(const char* begin, const char* end, int first_line) {
  int line = first_line;
  for (const char* s = begin; s < end; ++line) {
    const char* next = blank_line_ == 0 ? TakeRow<kBlanksSeparate>(s, end) : nullptr;
    if (next != nullptr) {
      Commit();
    } else {
      const auto* stop =
          static_cast<const char*>(std::memchr(s, '\n', static_cast<std::size_t>(end - s)));
      TakeUnusualLine(std::string_view(s, static_cast<std::size_t>(stop - s)), line);
      next = stop + 1;
    }
    s = next;
  }
  return line - first_line;
}

void TextRows::TakeUnusualLine(std::string_view line, int number) {
  const bool is_comment = IsComment(line);
  if (is_comment || Trim(line).empty()) {
    if (!is_comment && blank_line_ == 0) blank_line_ = number;
    const std::size_t rows = columns_.front().size();
    if (line_of_row_.back().first == rows) line_of_row_.pop_back();
    line_of_row_.emplace_back(rows, number + 1);
    return;
  }
  if (blank_line_ > 0) Fail(blank_line_, "", "a blank line inside the data, expected a row");
  std::vector<std::string_view> fields = SplitFields(line, layout_.separator);
  const std::size_t expected = slot_of_.size();
  if (fields.size() == expected + 1 && (layout_.has_comments || Trim(fields.back()).empty())) {
    fields.pop_back();
  }
  if (fields.size() != expected) {
    const std::string names = layout_.names.empty() ? "" : " (" + ListNames(layout_.names) + ")";
    Fail(number, "",
         "a row of " + std::to_string(fields.size()) + " columns, expected " +
             std::to_string(expected) + names + hint_);
  }
  for (std::size_t c = 0; c < expected; ++c) {
    if (slot_of_[c] < 0) continue;
    const auto slot = static_cast<std::size_t>(slot_of_[c]);
    const std::string_view field = Trim(fields[c]);
    const std::optional<double> value = ParseField(field);
    if (!value) {
      const bool comma = field.find(',') != std::string_view::npos;
      Fail(number, display_names_[slot],
           (field.empty() ? std::string("empty") : "'" + std::string(field) + "'") +
               ", expected a number" + (comma ? " with a decimal point" : "") + hint_);
    }
    row_[slot] = *value;
  }
  Commit();
}

int TextRows::LineOf(std::size_t row) const {
  const auto after = std::upper_bound(
      line_of_row_.begin(), line_of_row_.end(), row,
      [](std::size_t wanted, const std::pair<std::size_t, int>& at) { return wanted < at.first; });
  if (after == line_of_row_.begin()) return 0;
  const auto& [first_row, first_line] = *(after - 1);
  return first_line + static_cast<int>(row - first_row);
}

void TextRows::Fail(int line, const std::string& key, const std::string& what) const {
  throw UserError(file_, line, key, what);
}

}  // namespace howl
