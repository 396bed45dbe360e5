#include "tests/fuzz/target.h"

#include <glog/logging.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <new>

#include "io/user_error.h"

namespace howl {

std::vector<FuzzTarget> AllTargets() {
  std::vector<FuzzTarget> all;
  for (const auto& some : {ConfigTargets(), RecordTargets(), ResultTargets(), StateTargets()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::filesystem::path MemoryFile(std::string_view bytes) {
  thread_local const int descriptor = memfd_create("input", MFD_CLOEXEC);
  CHECK_GE(descriptor, 0);
  CHECK_EQ(ftruncate(descriptor, 0), 0);
  CHECK_EQ(pwrite(descriptor, bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  return "/proc/self/fd/" + std::to_string(descriptor);
}

void Answered(const std::function<void()>& read) {
  constexpr std::size_t kLongestLine = 2000;
  try {
    read();
  } catch (const UserError& error) {
    const std::string_view line = error.what();
    CHECK(!line.empty() && line.size() < kLongestLine) << line;
    CHECK(std::ranges::none_of(line, [](char c) { return c == '\n' || c == '\r' || c == '\x1b'; }))
        << line;
  } catch (const std::bad_alloc&) {
    // main() says that there is not enough memory.
  }
}

}  // namespace howl
