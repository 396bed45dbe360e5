// Output files appear whole or not at all.
#ifndef HOWL_IO_WHOLE_FILE_H_
#define HOWL_IO_WHOLE_FILE_H_

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace howl {

// A file that is not there until Publish(); without it nothing is left behind. Folders on its way
// are made where they are missing. Throws UserError naming the path where the disk refuses.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void Write(const char* data, std::size_t size);
  void Publish();

 private:
  [[noreturn]] void Fail(const char* what) const;

  std::filesystem::path path_;
  std::string temporary_;
  int descriptor_ = -1;
  bool published_ = false;
};

void WriteWholeFile(const std::filesystem::path& path, std::string_view content);

// The bytes of a regular file; nothing where it is none or cannot be read.
std::optional<std::string> ReadWholeFile(const std::filesystem::path& path);

// Removes what runs that were killed left of files in `folder` that they had not published, of
// those alone whose names begin with `prefix`. Nobody else may be writing these.
void RemoveUnpublished(const std::filesystem::path& folder, std::string_view prefix = "");

}  // namespace howl

#endif  // HOWL_IO_WHOLE_FILE_H_
