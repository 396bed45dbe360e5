#include "io/records/text/text_table.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "io/config/yaml/config_text.h"
#include "io/records/columns/number_text.h"
#include "io/records/columns/time_unit.h"
#include "io/records/text/labview_header.h"
#include "io/records/text/line_blocks.h"
#include "io/records/text/text_dialect.h"
#include "io/records/text/text_layout.h"
#include "io/records/text/text_rows.h"
#include "io/records/text/utf16_bytes.h"
#include "io/user_error.h"

namespace howl {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
// Of no record: each is looked for among the others by its name.
constexpr std::size_t kMostColumns = 5000;

class TextTable final : public TableSource {
 public:
  TextTable(const std::filesystem::path& file, const TextDialect& dialect)
      : file_(file.string()), dialect_(dialect) {
    try {
      blocks_.emplace(AsUtf8(OpenBytes(file)));
    } catch (const ByteError& error) {
      throw UserError(file_, 0, "", error.what());
    }
    ReadLayout();
  }

  Columns Read(const std::vector<ColumnName>& names) override;
  std::vector<ColumnInfo> List() const override;
  std::string Format() const override;
  std::optional<double> StatedRateHz() const override;
  std::string NameOf(const ColumnName& name) const override { return Label(Find(name)); }
  int LineOf(std::size_t row) const override { return rows_ ? rows_->LineOf(row) : 0; }

 private:
  bool NextBlock();
  void ReadLayout();
  void LookAtStart();
  std::string Label(std::size_t column) const;
  void RefuseBinary() const;
  std::size_t Find(const ColumnName& name) const;
  [[noreturn]] void Fail(int line, const std::string& key, const std::string& what) const {
    throw UserError(file_, line, key, what);
  }

  std::string file_;
  TextDialect dialect_;
  std::optional<LabviewHeader> labview_;
  std::string hint_;  // where another dialect makes a table, and this one none
  std::optional<LineBlocks> blocks_;
  const char* at_ = nullptr;  // the next line, in the current block
  int line_ = 1;              // its number
  TextLayout layout_;
  int header_line_ = 1;
  std::optional<TextRows> rows_;
};

bool TextTable::NextBlock() {
  try {
    if (!blocks_->Next()) return false;
  } catch (const ByteError& error) {
    Fail(line_, "", error.what());
  }
  at_ = blocks_->begin();
  return true;
}

// Text has no bytes below 9 (tab), and none of those from 14 to 31.
void TextTable::RefuseBinary() const {
  const auto is_binary = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 9 || (byte > 13 && byte < 32);
  };
  constexpr std::ptrdiff_t kLooked = 4096;
  const char* end = blocks_->begin() + std::min(kLooked, blocks_->end() - blocks_->begin());
  const char* found = std::find_if(blocks_->begin(), end, is_binary);
  if (found == end) return;
  Fail(1 + static_cast<int>(std::count(blocks_->begin(), found, '\n')), "",
       "binary data, expected text (plain or gzip), MATLAB .mat or HDF5");
}

void TextTable::ReadLayout() {
  bool first_block = true;
  while (NextBlock()) {
    if (first_block) {
      RefuseBinary();
      LookAtStart();
      first_block = false;
    }
    while (at_ < blocks_->end()) {
      const auto* stop = static_cast<const char*>(
          std::memchr(at_, '\n', static_cast<std::size_t>(blocks_->end() - at_)));
      const int skipped = labview_ ? labview_->lines : dialect_.skip_rows;
      if (const void* cr = std::memchr(at_, '\r', static_cast<std::size_t>(stop - at_));
          cr != nullptr && cr != stop - 1) {
        Fail(line_, "", "a carriage return inside a line, expected lines that end in LF or CRLF");
      }
      if (line_ <= skipped) {
        at_ = stop + 1;
        ++line_;
        continue;
      }
      const bool had_names = !layout_.names.empty();
      if (layout_.TakeLine(std::string_view(at_, static_cast<std::size_t>(stop - at_)))) {
        if (layout_.columns <= kMostColumns) return;
        Fail(line_, "",
             "a row of " + std::to_string(layout_.columns) + " columns, expected at most " +
                 std::to_string(kMostColumns));
      }
      if (!had_names && !layout_.names.empty()) header_line_ = line_;
      at_ = stop + 1;
      ++line_;
    }
  }
  if (first_block) Fail(1, "", "an empty file, expected columns of numbers");
  if (line_ - 1 <= dialect_.skip_rows) {
    Fail(0, "skip_rows",
         std::to_string(dialect_.skip_rows) + " leaves nothing of " + std::to_string(line_ - 1) +
             " lines, expected fewer");
  }
  Fail(line_ - 1, "", "no rows of numbers, expected at least 32" + hint_);
}

// Another separator than the rows' own, and what stands before the table, show in the first lines.
void TextTable::LookAtStart() {
  std::string_view start(at_, static_cast<std::size_t>(blocks_->end() - at_));
  if (start.starts_with(kByteOrderMark)) {
    at_ += kByteOrderMark.size();
    start.remove_prefix(kByteOrderMark.size());
  }
  if (dialect_.skip_rows == 0) labview_ = ReadLabviewHeader(start);
  layout_.decimal_comma = dialect_.decimal_comma || (labview_ && labview_->decimal_comma);
  if (labview_) {
    layout_.separator = labview_->separator;
    layout_.has_comments = true;
    return;
  }
  std::vector<std::string_view> lines;
  while (!start.empty() && lines.size() < kDialectLines) {
    const std::size_t end = start.find('\n');
    lines.push_back(start.substr(0, end));
    start.remove_prefix(end + 1);
  }
  hint_ = DialectHint(lines, dialect_);
}

std::string TextTable::Label(std::size_t column) const {
  if (layout_.names.empty()) return "";
  const std::string& name = layout_.names[column];
  const std::string unit = column < layout_.units.size() ? layout_.units[column] : "";
  if (unit.empty() || TimeUnitOfName(name)) return name;
  return name + (std::string_view("[({").find(unit.front()) == std::string_view::npos
                     ? " [" + unit + "]"
                     : " " + unit);
}

std::vector<ColumnInfo> TextTable::List() const {
  const std::vector<std::string>& names = layout_.names;
  std::vector<ColumnInfo> columns;
  for (std::size_t i = 0; i < layout_.columns; ++i) {
    ColumnInfo& column = columns.emplace_back();
    // A config is UTF-8, which a header in another encoding is not.
    const bool is_own = i < names.size() && !names[i].empty() &&
                        FindNoText(names[i]) == std::string::npos &&
                        std::count(names.begin(), names.end(), names[i]) == 1;
    column.name = is_own ? names[i] : std::to_string(i + 1);
    column.label = Label(i);
    const std::string value = i < layout_.first_row.size() ? layout_.first_row[i] : "";
    if (!layout_.IsNumber(value)) column.problem = value.empty() ? "empty" : "text";
  }
  return columns;
}

std::string TextTable::Format() const {
  const char separator = layout_.separator;
  return std::string(labview_ ? "LabVIEW text" : "text") + ", columns parted by " +
         (separator == kWhiteSpace ? "blanks"
          : separator == '\t'      ? "tabs"
          : separator == ','       ? "commas"
                                   : "semicolons") +
         (layout_.names.empty() ? ", no header" : ", a header") +
         (layout_.units.empty() ? "" : " and a row of units") +
         (layout_.decimal_comma ? ", decimal commas" : "");
}

std::optional<double> TextTable::StatedRateHz() const {
  if (!labview_ || !labview_->step_s) return std::nullopt;
  // Delta_X has six decimals: 1.000000E-4, and 10 kHz.
  return RoundedTo(1.0 / *labview_->step_s, 6);
}

std::size_t TextTable::Find(const ColumnName& name) const {
  const std::vector<std::string>& names = layout_.names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) {
    if (std::find(found + 1, names.end(), name) != names.end()) {
      Fail(header_line_, name,
           "more than one column has this name, expected a number from 1 to " +
               std::to_string(layout_.columns));
    }
    return static_cast<std::size_t>(found - names.begin());
  }
  const std::size_t number = ColumnNumber(name);
  if (number >= 1 && number <= layout_.columns) return number - 1;
  const std::string numbers = "a number from 1 to " + std::to_string(layout_.columns);
  if (names.empty()) {
    Fail(line_, DisplayName(name),
         (number > 0 ? "no such column, expected " : "the file has no header, expected ") +
             numbers + hint_);
  }
  Fail(header_line_, DisplayName(name),
       "no such column, expected one of " + ListNames(names) + ", or " + numbers + hint_);
}

Columns TextTable::Read(const std::vector<ColumnName>& names) {
  std::vector<std::size_t> wanted;
  std::vector<std::string> display;
  for (const ColumnName& name : names) {
    const std::size_t column = Find(name);
    if (std::find(wanted.begin(), wanted.end(), column) != wanted.end()) {
      Fail(header_line_, DisplayName(name), "the same column is asked for twice");
    }
    wanted.push_back(column);
    display.push_back(DisplayName(name));
  }
  rows_.emplace(file_, layout_, wanted, std::move(display), hint_);
  do {
    if (layout_.decimal_comma) blocks_->Replace(at_, ',', '.');
    line_ += rows_->TakeBlock(at_, blocks_->end(), line_, blocks_->FractionRead());
  } while (NextBlock());
  return rows_->TakeColumns();
}

}  // namespace

std::unique_ptr<TableSource> OpenTextTable(const std::filesystem::path& file,
                                           const TextDialect& dialect) {
  return std::make_unique<TextTable>(file, dialect);
}

}  // namespace howl
