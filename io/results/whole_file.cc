#include "io/results/whole_file.h"

#include <unistd.h>

#include <fstream>
#include <string>
#include <system_error>

#include "io/user_error.h"

namespace howl {

void WriteWholeFile(const std::filesystem::path& path, std::string_view content) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) {
    throw UserError(path.parent_path().string(), 0, "",
                    "cannot make this folder: " + error.message());
  }
  const std::filesystem::path temporary =
      path.string() + ".part" + std::to_string(static_cast<long>(getpid()));
  {
    std::ofstream file(temporary, std::ios::binary);
    file << content;
    file.flush();
    if (!file) {
      std::filesystem::remove(temporary, error);
      throw UserError(path.string(), 0, "", "cannot write this file, expected a writable folder");
    }
  }
  std::filesystem::rename(temporary, path, error);
  if (error) throw UserError(path.string(), 0, "", "cannot write this file: " + error.message());
}

}  // namespace howl
