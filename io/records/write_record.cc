#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

#include "io/records/records.h"
#include "io/user_error.h"

namespace howl {
namespace {

// A file that is not there until Publish().
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& path)
      : path_(path), temporary_(path.string() + ".XXXXXX") {
    descriptor_ = mkostemp(temporary_.data(), O_CLOEXEC);
    if (descriptor_ < 0) Fail("cannot be created");
    // mkostemp's files are for their owner alone; this one is to be as any other.
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor_, 0666 & ~mask);
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!published_) unlink(temporary_.c_str());
  }

  void Write(const char* data, std::size_t size) {
    while (size > 0) {
      const ssize_t written = write(descriptor_, data, size);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) Fail("cannot be written");
      data += written;
      size -= static_cast<std::size_t>(written);
    }
  }

  void Publish() {
    const int status = close(descriptor_);
    descriptor_ = -1;
    if (status != 0) Fail("cannot be written");
    if (rename(temporary_.c_str(), path_.c_str()) != 0) Fail("cannot be put in its place");
    published_ = true;
  }

 private:
  [[noreturn]] void Fail(const char* what) const {
    const std::string reason = strerror(errno);
    if (descriptor_ >= 0) unlink(temporary_.c_str());
    throw UserError(path_.string(), 0, "", std::string(what) + ": " + reason);
  }

  std::filesystem::path path_;
  std::string temporary_;
  int descriptor_ = -1;
  bool published_ = false;
};

}  // namespace

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
