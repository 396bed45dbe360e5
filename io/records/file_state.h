// Whether a file was written to while it was read.
#ifndef HOWL_IO_RECORDS_FILE_STATE_H_
#define HOWL_IO_RECORDS_FILE_STATE_H_

#include <sys/stat.h>

#include <ctime>
#include <filesystem>

namespace howl {

// Equal before and after where nothing was written in between, and for what is no regular file.
struct FileState {
  explicit FileState(const std::filesystem::path& file) {
    struct stat now {};
    if (stat(file.c_str(), &now) != 0 || !S_ISREG(now.st_mode)) return;
    bytes = now.st_size;
    changed_s = now.st_mtim.tv_sec;
    changed_ns = now.st_mtim.tv_nsec;
  }
  bool operator==(const FileState&) const = default;

  off_t bytes = 0;
  std::time_t changed_s = 0;
  long changed_ns = 0;
};

}  // namespace howl

#endif  // HOWL_IO_RECORDS_FILE_STATE_H_
