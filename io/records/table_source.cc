#include "io/records/table_source.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "io/records/hdf5_table.h"
#include "io/records/mat_table.h"
#include "io/records/text_table.h"
#include "io/user_error.h"

namespace howl {
namespace {

constexpr std::string_view kHdf5Magic("\x89HDF\r\n\x1a\n", 8);
constexpr std::size_t kMatlabHeaderBytes = 512;  // MATLAB 7.3 puts HDF5 behind its own header

struct Foreign {
  std::string_view magic;
  const char* what;
};
constexpr Foreign kForeign[] = {{"PK\x03\x04", "a zip archive or a spreadsheet"},
                                {"\xfd\x37zXZ", "an xz file"},
                                {"BZh", "a bzip2 file"},
                                {"\x28\xb5\x2f\xfd", "a zstd file"}};

void RequireNoDialect(const std::filesystem::path& file, const TextDialect& dialect,
                      const char* format) {
  if (dialect == TextDialect()) return;
  throw UserError(
      file.string(), 0, dialect.skip_rows > 0 ? "skip_rows" : "decimal",
      std::string("is of text files, and this is ") + format + ", expected the record without it");
}

std::string ReadStart(const std::filesystem::path& file) {
  std::array<char, 1024> start{};
  std::ifstream in(file, std::ios::binary);
  if (!in) throw UserError(file.string(), 0, "", std::string("cannot open: ") + strerror(errno));
  in.read(start.data(), start.size());
  return std::string(start.data(), static_cast<std::size_t>(in.gcount()));
}

}  // namespace

std::unique_ptr<TableSource> OpenTable(const std::filesystem::path& file,
                                       const TextDialect& dialect) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw UserError(file.string(), 0, "", "a folder, expected a file");
  }
  // A pipe gives its bytes once, so that nothing may look at them beforehand: it carries text.
  const bool is_there = std::filesystem::exists(file, ignored);
  if (is_there && !std::filesystem::is_regular_file(file, ignored)) {
    return OpenTextTable(file, dialect);
  }
  const std::string start = ReadStart(file);
  if (start.empty()) {
    throw UserError(file.string(), 1, "", "an empty file, expected columns of numbers");
  }
  if (start.starts_with("MATLAB 5.0 MAT-file") || start.starts_with("MATLAB 7.")) {
    RequireNoDialect(file, dialect, "a MATLAB file");
    return OpenMatTable(file);
  }
  if (start.starts_with(kHdf5Magic) ||
      (start.size() > kMatlabHeaderBytes &&
       std::string_view(start).substr(kMatlabHeaderBytes).starts_with(kHdf5Magic))) {
    RequireNoDialect(file, dialect, "an HDF5 file");
    return OpenHdf5Table(file);
  }
  for (const Foreign& foreign : kForeign) {
    if (start.starts_with(foreign.magic)) {
      throw UserError(
          file.string(), 0, "",
          std::string(foreign.what) + ", expected text (plain or gzip), MATLAB .mat or HDF5");
    }
  }
  return OpenTextTable(file, dialect);
}

std::string TableSource::NameOf(const ColumnName& name) const {
  const std::size_t channel = name.rfind(':');
  const bool is_channel =
      channel != std::string::npos && ColumnNumber(name.substr(channel + 1)) > 0;
  if (is_channel) return name.substr(0, channel);
  return ColumnNumber(name) > 0 ? std::string() : name;
}

std::string DisplayName(const ColumnName& name) {
  return ColumnNumber(name) > 0 ? "column " + name : name;
}

std::size_t ColumnNumber(const std::string& name) {
  std::size_t number = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, number);
  return error == std::errc() && stop == end ? number : 0;
}

std::string ListNames(const std::vector<std::string>& names) {
  constexpr std::size_t kMaxListed = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMaxListed); ++i) {
    list += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > kMaxListed) {
    list += " and " + std::to_string(names.size() - kMaxListed) + " more";
  }
  return list;
}

}  // namespace howl
