#include "tests/fuzz/target.h"

#include <glog/logging.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <new>
#include <system_error>

#include "io/user_error.h"
#include "io/utf8_text.h"

namespace howl {

namespace fs = std::filesystem;

std::vector<FuzzTarget> AllTargets() {
  std::vector<FuzzTarget> all;
  for (const auto& some :
       {ConfigTargets(), RecordTargets(), ResultTargets(), StateTargets(), KeptTargets()}) {
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

void WriteFiles(const fs::path& folder, std::span<const std::string_view> known,
                std::string_view input) {
  constexpr std::string_view kFileMark = "#file ";
  for (const std::string_view name : known) {
    fs::create_directories((folder / name).parent_path());
    fs::remove(folder / name);
  }
  while (input.starts_with(kFileMark)) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    const std::string_view name = input.substr(kFileMark.size(), end - kFileMark.size());
    input.remove_prefix(std::min(end + 1, input.size()));
    const std::size_t next = std::min(input.find("\n#file "), input.size());
    if (std::ranges::find(known, name) != known.end()) {
      std::ofstream(folder / name, std::ios::binary) << input.substr(0, next);
    }
    input.remove_prefix(std::min(next + 1, input.size()));
  }
}

void CheckIsOneLine(std::string_view line) {
  constexpr std::size_t kLongestLine = 2000;
  CHECK(!line.empty() && line.size() < kLongestLine) << line;
  CHECK(std::ranges::none_of(line, [](char c) { return c == '\n' || c == '\r' || c == '\x1b'; }))
      << line;
  CHECK(AsUtf8Text(line) == line) << line;
}

void Answered(const std::function<void()>& read) {
  try {
    read();
  } catch (const UserError& error) {
    CheckIsOneLine(error.what());
  } catch (const std::bad_alloc&) {
    // main() says that there is not enough memory.
  }
}

}  // namespace howl
