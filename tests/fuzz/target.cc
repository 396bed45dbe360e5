#include "tests/fuzz/target.h"

#include <glog/logging.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <new>
#include <system_error>

#include "io/user_error.h"

namespace howl {

namespace fs = std::filesystem;

std::vector<FuzzTarget> AllTargets() {
  std::vector<FuzzTarget> all;
  for (const auto& some : {ConfigTargets(), RecordTargets(), ResultTargets(), StateTargets()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

const std::filesystem::path& ScratchFolder() {
  struct Folder {
    Folder() {
      const fs::path parent = fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
      std::string form = (parent / "howl_fuzz_XXXXXX").string();
      CHECK(mkdtemp(form.data()) != nullptr);
      path = form;
    }
    ~Folder() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
    fs::path path;
  };
  static const Folder folder;
  return folder.path;
}

// Not memfd_create(), whose files have no name that the HDF5 library takes.
std::filesystem::path InputFile(std::string_view bytes) {
  fs::path path = ScratchFolder() / "input";
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  CHECK(file.flush().good());
  return path;
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
