#include <charconv>
#include <string>

#include "io/records/records.h"
#include "io/whole_file.h"

namespace howl {
void WriteRecordCsv(const std::filesystem::path& path, const Record& record) {
  constexpr std::size_t kBlockBytes = std::size_t{1} << 18;
  constexpr std::size_t kLongestRow = 64;  // two doubles of at most 24 characters
  NewFile file(path);
  const bool has_heat_release = !record.heat_release.empty();
  std::string block(kBlockBytes + kLongestRow, '\0');
  const std::string header = has_heat_release ? "p,q\n" : "p\n";
  file.Write(header.data(), header.size());
  char* at = block.data();
  char* const full = block.data() + kBlockBytes;
  char* const end = block.data() + block.size();
  for (std::size_t i = 0; i < record.pressure.size(); ++i) {
    at = std::to_chars(at, end, record.pressure[i]).ptr;
    if (has_heat_release) {
      *at++ = ',';
      at = std::to_chars(at, end, record.heat_release[i]).ptr;
    }
    *at++ = '\n';
    if (at >= full) {
      file.Write(block.data(), static_cast<std::size_t>(at - block.data()));
      at = block.data();
    }
  }
  file.Write(block.data(), static_cast<std::size_t>(at - block.data()));
  file.Publish();
}

}  // namespace howl
