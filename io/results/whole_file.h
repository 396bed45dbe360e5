// Output files appear whole or not at all.
#ifndef HOWL_IO_RESULTS_WHOLE_FILE_H_
#define HOWL_IO_RESULTS_WHOLE_FILE_H_

#include <filesystem>
#include <string_view>

namespace howl {

// Writes to a temporary file beside `path`, then renames it; makes the folder where it is missing.
// Throws UserError naming the path where the disk refuses.
void WriteWholeFile(const std::filesystem::path& path, std::string_view content);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_WHOLE_FILE_H_
