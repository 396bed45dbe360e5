#include "io/records/text_table.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "io/records/line_blocks.h"
#include "io/records/text_layout.h"
#include "io/records/text_rows.h"
#include "io/user_error.h"

namespace howl {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

class TextTable final : public TableSource {
 public:
  explicit TextTable(const std::filesystem::path& file) : file_(file.string()) {
    try {
      blocks_.emplace(OpenBytes(file));
    } catch (const ByteError& error) {
      throw UserError(file_, 0, "", error.what());
    }
    ReadLayout();
  }

  Columns Read(const std::vector<ColumnName>& names) override;
  std::string NameOf(const ColumnName& name) const override {
    return layout_.names.empty() ? std::string() : layout_.names[Find(name)];
  }
  int LineOf(std::size_t row) const override { return rows_ ? rows_->LineOf(row) : 0; }

 private:
  bool NextBlock();
  void ReadLayout();
  void RefuseBinary() const;
  std::size_t Find(const ColumnName& name) const;
  [[noreturn]] void Fail(int line, const std::string& key, const std::string& what) const {
    throw UserError(file_, line, key, what);
  }

  std::string file_;
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
      const std::string_view start(at_, static_cast<std::size_t>(blocks_->end() - at_));
      if (start.starts_with(kByteOrderMark)) at_ += kByteOrderMark.size();
      first_block = false;
    }
    while (at_ < blocks_->end()) {
      const auto* stop = static_cast<const char*>(
          std::memchr(at_, '\n', static_cast<std::size_t>(blocks_->end() - at_)));
      if (const void* cr = std::memchr(at_, '\r', static_cast<std::size_t>(stop - at_));
          cr != nullptr && cr != stop - 1) {
        Fail(line_, "", "a carriage return inside a line, expected lines that end in LF or CRLF");
      }
      const bool had_names = !layout_.names.empty();
      if (layout_.TakeLine(std::string_view(at_, static_cast<std::size_t>(stop - at_)))) return;
      if (!had_names && !layout_.names.empty()) header_line_ = line_;
      at_ = stop + 1;
      ++line_;
    }
  }
  if (first_block) Fail(1, "", "an empty file, expected columns of numbers");
  Fail(line_ - 1, "", "no rows of numbers, expected at least 16");
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
    Fail(
        line_, DisplayName(name),
        (number > 0 ? "no such column, expected " : "the file has no header, expected ") + numbers);
  }
  Fail(header_line_, DisplayName(name),
       "no such column, expected one of " + ListNames(names) + ", or " + numbers);
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
  rows_.emplace(file_, layout_, wanted, std::move(display));
  do {
    line_ += rows_->TakeBlock(at_, blocks_->end(), line_, blocks_->FractionRead());
  } while (NextBlock());
  return rows_->TakeColumns();
}

}  // namespace

std::unique_ptr<TableSource> OpenTextTable(const std::filesystem::path& file) {
  return std::make_unique<TextTable>(file);
}

}  // namespace howl
