#include "io/inspect/text_start.h"

#include <string_view>
#include <system_error>
#include <vector>

#include "io/records/text/labview_header.h"
#include "io/records/text/line_blocks.h"
#include "io/records/text/text_dialect.h"
#include "io/records/text/utf16_bytes.h"

namespace howl {

TextDialect GuessDialectOf(const std::filesystem::path& file) {
  std::error_code ignored;
  // A pipe gives its bytes once.
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  try {
    LineBlocks blocks(AsUtf8(OpenBytes(file)));
    if (!blocks.Next()) return {};
    std::string_view start(blocks.begin(), static_cast<std::size_t>(blocks.end() - blocks.begin()));
    if (start.starts_with("\xef\xbb\xbf")) start.remove_prefix(3);
    if (ReadLabviewHeader(start)) return {};  // which says all of it
    std::vector<std::string_view> lines;
    while (!start.empty() && lines.size() < kDialectLines) {
      const std::size_t end = start.find('\n');
      lines.push_back(start.substr(0, end));
      start.remove_prefix(end + 1);
    }
    return GuessDialect(lines).value_or(TextDialect());
  } catch (const ByteError&) {
    return {};  // the reader says what is wrong
  }
}

}  // namespace howl
