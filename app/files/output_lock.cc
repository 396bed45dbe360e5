#include "app/files/output_lock.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "io/user_error.h"

namespace howl {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// What a killed run had started may take a moment to end.
constexpr auto kPatience = std::chrono::seconds(2);
constexpr auto kBetweenTries = std::chrono::milliseconds(20);

// A shard has two: its own and that of the folder.
std::array<std::atomic<const OutputLock*>, 2> held{};

void Replace(const OutputLock* old_lock, const OutputLock* new_lock) {
  const auto place = std::ranges::find_if(
      held, [&](const std::atomic<const OutputLock*>& each) { return each == old_lock; });
  if (place != held.end()) *place = new_lock;
}

// The folders on the way to `folder` that are not there, the innermost first.
std::vector<fs::path> Missing(const fs::path& folder) {
  std::error_code ignored;
  std::vector<fs::path> missing;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, ignored); at = at.parent_path()) {
    missing.push_back(at);
    if (at == at.parent_path()) break;
  }
  return missing;
}

std::string ReadAll(int descriptor) {
  std::array<char, 200> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  return {text.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

// False where another run has removed the file since it was opened: the lock would be on nothing.
bool IsStill(int descriptor, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

// While it lives a signal that ends the program waits: it would find a lock's file that is not
// among those which are held, and leave it.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t ends;
    sigemptyset(&ends);
    sigaddset(&ends, SIGINT);
    sigaddset(&ends, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &ends, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

OutputLock::OutputLock(fs::path folder, const std::string& file, Kind kind, const std::string& who)
    : folder_(std::move(folder)), path_(folder_ / file), made_(Missing(folder_)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) {
    throw UserError(folder_.string(), 0, "", "cannot make this folder: " + error.message());
  }
  const Clock::time_point last = Clock::now() + kPatience;
  const auto takes = [&] {
    const SignalsWait while_it_is_made;
    const bool taken = Take(kind);
    if (taken) Replace(nullptr, this);
    return taken;
  };
  while (!takes()) {
    const std::string other = ReadAll(descriptor_);
    close(descriptor_);
    if (Clock::now() > last) {
      throw UserError(folder_.string(), 0, "",
                      "another run is writing here" + (other.empty() ? "" : " (" + other + ")") +
                          ", expected its end, or another --out");
    }
    std::this_thread::sleep_for(kBetweenTries);
  }
  if (kind == Kind::kTogether) return;
  // It is for a message alone; a full disk refuses it.
  const std::string text = who + ", process " + std::to_string(getpid());
  [[maybe_unused]] const bool written =
      ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, text.data(), text.size(), 0) > 0;
}

// False where it is another's just now.
bool OutputLock::Take(Kind kind) {
  descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    const std::string reason = std::strerror(errno);
    for (const fs::path& folder : made_) rmdir(folder.c_str());
    throw UserError(folder_.string(), 0, "", "cannot be written: " + reason);
  }
  if (flock(descriptor_, (kind == Kind::kAlone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) {
    return IsStill(descriptor_, path_);
  }
  return errno != EWOULDBLOCK && errno != EINTR;  // else this file system has no locks
}

void OutputLock::Remove() const {
  // Whoever has it together with others leaves the file to the last of them.
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return;
  unlink(path_.c_str());
  for (const fs::path& folder : made_) {
    if (rmdir(folder.c_str()) != 0) break;
  }
}

OutputLock::~OutputLock() {
  const SignalsWait while_it_goes;
  Remove();
  Replace(this, nullptr);
  close(descriptor_);
}

void OutputLock::RemoveAll() {
  // The last that was taken is the innermost.
  for (std::size_t i = held.size(); i-- > 0;) {
    if (const OutputLock* const lock = held[i].load()) lock->Remove();
  }
}

}  // namespace howl
