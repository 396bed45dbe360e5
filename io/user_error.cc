#include "io/user_error.h"

#include <cstddef>

namespace howl {
namespace {

constexpr std::size_t kMaxPartLength = 300;

std::string OneLine(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (line.size() >= kMaxPartLength) return line + "...";
    const bool is_control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    line += is_control ? ' ' : c;
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
