#include "io/whole_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <vector>

#include "io/user_error.h"

namespace howl {
namespace {

// report.html is .report.html.howl-XXXXXX until it is published: hidden, and a name that no user
// gives.
constexpr std::string_view kMark = ".howl-";
constexpr std::string_view kRandom = "XXXXXX";

std::string TemporaryName(const std::filesystem::path& path) {
  const std::string name =
      "." + path.filename().string() + std::string(kMark) + std::string(kRandom);
  return (path.parent_path() / name).string();
}

}  // namespace

NewFile::NewFile(const std::filesystem::path& path) : path_(path), temporary_(TemporaryName(path)) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) {
    throw UserError(path.parent_path().string(), 0, "",
                    "cannot make this folder: " + error.message());
  }
  descriptor_ = mkostemp(temporary_.data(), O_CLOEXEC);
  if (descriptor_ < 0) Fail("cannot be created");
  // mkostemp's files are for their owner alone; this file gets the permissions of any other.
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(descriptor_, 0666 & ~mask);
}

NewFile::~NewFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!published_) unlink(temporary_.c_str());
}

void NewFile::Write(const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(descriptor_, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) Fail("cannot be written");
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

// A file system may put the new name on the disk before the bytes: a loss of power between the two
// would leave an empty file in the old one's place.
void NewFile::Publish() {
  // Some file systems, and all pipes, do not support it.
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) Fail("cannot be written");
  const int status = close(descriptor_);
  descriptor_ = -1;
  if (status != 0) Fail("cannot be written");
  if (rename(temporary_.c_str(), path_.c_str()) != 0) Fail("cannot be put in its place");
  published_ = true;
  const std::string folder = path_.has_parent_path() ? path_.parent_path().string() : ".";
  const int directory = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  fsync(directory);  // the file is whole either way
  close(directory);
}

void NewFile::Fail(const char* what) const {
  const std::string reason = strerror(errno);
  if (descriptor_ >= 0) unlink(temporary_.c_str());
  throw UserError(path_.string(), 0, "", std::string(what) + ": " + reason);
}

void WriteWholeFile(const std::filesystem::path& path, std::string_view content) {
  NewFile file(path);
  file.Write(content.data(), content.size());
  file.Publish();
}

std::optional<std::string> ReadWholeFile(const std::filesystem::path& path) {
  // A device may never end.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

void RemoveUnpublished(const std::filesystem::path& folder, std::string_view prefix) {
  std::error_code error;
  std::vector<std::filesystem::path> found;
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().filename().string();
    const bool is_ours =
        name.starts_with("." + std::string(prefix)) &&
        name.size() > kMark.size() + kRandom.size() &&
        name.compare(name.size() - kRandom.size() - kMark.size(), kMark.size(), kMark) == 0;
    if (is_ours) found.push_back(at->path());
  }
  for (const std::filesystem::path& path : found) unlink(path.c_str());
}

}  // namespace howl
