#include "io/user_error.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "io/utf8_text.h"

namespace howl {
namespace {

constexpr std::size_t kMaxPartLength = 300;

// A part of a text that was cut, or a name of a file, may have half a character.
std::string OneLine(const std::string& text) {
  std::string line;
  for (std::size_t i = 0; i < text.size();) {
    if (line.size() >= kMaxPartLength) return line + "...";
    const std::size_t length = Utf8Length(std::string_view(text).substr(i));
    const bool is_control = static_cast<unsigned char>(text[i]) < 0x20 || text[i] == 0x7f;
    line += is_control ? " " : length == 0 ? "?" : text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return line;
}

std::string Format(const std::string& file, int line, const std::string& key,
                   const std::string& what) {
  std::string text = file;
  if (line > 0) text += ":" + std::to_string(line);
  text += ": ";
  if (!key.empty()) text += OneLine(key) + ": ";
  return text + OneLine(what);
}

}  // namespace

UserError::UserError(const std::string& file, int line, const std::string& key,
                     const std::string& what)
    : std::runtime_error(Format(file, line, key, what)),
      file_(file),
      line_(line),
      key_(OneLine(key)),
      mistake_(OneLine(what)) {}

}  // namespace howl
