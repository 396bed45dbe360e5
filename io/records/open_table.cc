#include "io/records/open_table.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "io/records/binary/hdf5_table.h"
#include "io/records/binary/mat_table.h"
#include "io/records/text/text_table.h"
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
// Files of samples that the Python package reads.
constexpr Foreign kConvertible[] = {
    {"TDSm", "an NI TDMS file"}, {"PAR1", "a Parquet file"}, {"\x93NUMPY", "a NumPy .npy file"}};
constexpr std::size_t kZipName = 30;  // where a zip archive has the name of its first file
constexpr std::size_t kZipNameLength = 26;

// The name of the first file of a zip archive.
std::string_view FirstInZip(std::string_view start) {
  if (start.size() < kZipName) return {};
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(start[i]));
  };
  return start.substr(kZipName, byte(kZipNameLength) + 256 * byte(kZipNameLength + 1));
}

// A universal file: a line with -1 alone, then one with the number of the data set.
bool IsUniversal(std::string_view start) {
  const auto line = [&] {
    const std::size_t end = std::min(start.find('\n'), start.size());
    std::string_view text = start.substr(0, end);
    start.remove_prefix(std::min(end + 1, start.size()));
    const std::size_t from = text.find_first_not_of(' ');
    if (from == std::string_view::npos) return std::string_view();
    return text.substr(from, text.find_first_of(" \r", from) - from);
  };
  if (!start.starts_with(' ') || line() != "-1") return false;
  const std::string_view set = line();
  return !set.empty() && set.size() <= 4 && set.find_first_not_of("0123456789b") == set.npos;
}

// What files of samples this is that the Python package reads and the program does not; empty if it
// is none.
std::string Convertible(std::string_view start) {
  for (const Foreign& each : kConvertible) {
    if (start.starts_with(each.magic)) return each.what;
  }
  const bool zip = start.starts_with(kForeign[0].magic);
  if (zip && FirstInZip(start).ends_with(".npy")) return "a NumPy .npz file";
  return IsUniversal(start) ? "a universal file (UFF)" : "";
}

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
  if (const std::string what = Convertible(start); !what.empty()) {
    const std::string name = file.filename().string();
    throw UserError(file.string(), 0, "",
                    what + ", expected text (plain or gzip), MATLAB .mat or HDF5: python -m howl " +
                        "convert " + name + " " + file.stem().string() + ".csv makes text of it");
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

}  // namespace howl
