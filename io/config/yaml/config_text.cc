#include "io/config/yaml/config_text.h"

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "io/config/yaml/config_table.h"
#include "io/user_error.h"
#include "io/utf8_text.h"

namespace howl {
namespace {

bool IsControl(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f;
}

// "gain" from "  - {gain: 12.14, ...".
std::string KeyOfLine(std::string_view line) {
  const auto is_key_char = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  line.remove_prefix(std::min(line.find_first_not_of(" \t-?{[\"'"), line.size()));
  std::size_t end = 0;
  while (end < line.size() && end < 64 && is_key_char(line[end])) ++end;
  const std::string_view key = line.substr(0, end);
  line.remove_prefix(end);
  line.remove_prefix(std::min(line.find_first_not_of(" \"'"), line.size()));
  return line.starts_with(':') ? std::string(key) : std::string();
}

std::string_view LineAt(std::string_view text, std::size_t begin) {
  return text.substr(begin, text.find('\n', begin) - begin);
}

void CheckLine(const std::string& file, const std::string& text, std::string_view line,
               int number) {
  const auto fail = [&](const std::string& what) {
    throw UserError(file, number, KeyNearLine(text, number), what);
  };
  if (line.size() > kMaxConfigLineBytes) {
    fail("the line is longer than " + std::to_string(kMaxConfigLineBytes >> 10) +
         " kB, expected shorter lines: samples belong in a record's file");
  }
  if (const std::size_t at = FindNoText(line); at != line.npos) {
    std::array<char, 8> code{};
    std::snprintf(code.data(), code.size(), "0x%02x",
                  static_cast<unsigned>(static_cast<unsigned char>(line[at])));
    fail(std::string("byte ") + code.data() + " at column " + std::to_string(at + 1) +
         " is not text, expected a YAML file in UTF-8");
  }
  const std::size_t indent = line.find_first_not_of(" \t\r");
  if (indent != std::string_view::npos && line.substr(0, indent).find('\t') != line.npos) {
    fail("a tab indents this line, expected spaces alone");
  }
}

}  // namespace

std::size_t FindNoText(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = Utf8Length(text.substr(i));
    if (length == 0 || IsControl(text[i])) return i;
    // U+0080 to U+009F steer a terminal as escape sequences do.
    if (text[i] == '\xc2' && static_cast<unsigned char>(text[i + 1]) < 0xa0) return i;
    i += length;
  }
  return std::string_view::npos;
}

std::string ReadConfigText(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw UserError(file, 0, "", "there is no such file, expected a config (YAML)");
  }
  if (std::filesystem::is_directory(status)) {
    throw UserError(file, 0, "", "this is a folder, expected a config (YAML) file in it");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::string text(kMaxConfigBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad() || (stream.fail() && !stream.eof())) {
    throw UserError(file, 0, "",
                    "cannot be read" + (errno != 0 ? ": " + std::string(strerror(errno)) : "") +
                        ", expected a readable config (YAML)");
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  // This is checked before the size and the bytes, which are wrong in such a file as well.
  const std::string record = DescribeRecordAsConfig(file, text);
  if (!record.empty()) throw UserError(file, 1, "experiments", record);
  int number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::string_view line = LineAt(text, begin);
    CheckLine(file, text, line, number);
    begin += line.size() + 1;
  }
  if (text.size() > kMaxConfigBytes) {
    throw UserError(file, number - 1, KeyNearLine(text, number - 1),
                    "the file is larger than " + std::to_string(kMaxConfigBytes >> 20) +
                        " MB, expected a smaller one: samples belong in a record's file");
  }
  return text;
}

std::string KeyNearLine(const std::string& text, int line) {
  std::string key;
  int number = 1;
  for (std::size_t begin = 0; begin < text.size() && number <= line; ++number) {
    const std::string_view content = LineAt(text, begin);
    std::string found = KeyOfLine(content);
    if (!found.empty()) key = std::move(found);
    begin += content.size() + 1;
  }
  return key;
}

}  // namespace howl
