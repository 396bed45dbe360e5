// A config's bytes, checked before any parser sees them.
#ifndef HOWL_IO_CONFIG_YAML_CONFIG_TEXT_H_
#define HOWL_IO_CONFIG_YAML_CONFIG_TEXT_H_

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace howl {

// These limits are generous for hand-written and generated configs alike; they bound the parser's
// time.
inline constexpr std::size_t kMaxConfigBytes = std::size_t{4} << 20;
inline constexpr std::size_t kMaxConfigLineBytes = std::size_t{256} << 10;

// UTF-8 text without control characters. Throws UserError for a missing file, a folder, a file or
// line that is too long, bytes that are not text, and a tab in an indentation.
std::string ReadConfigText(const std::filesystem::path& path);

// The position of the first byte that is no UTF-8 or is a control character (other than tab and
// line ends); npos where all is text.
std::size_t FindNoText(std::string_view text);

// The key with which a line (from 1), or the nearest one above it that has a key, begins; a message
// names it when the text does not parse. Empty where there is none.
std::string KeyNearLine(const std::string& text, int line);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_YAML_CONFIG_TEXT_H_
