// The dialect of a text file by its first lines.
#ifndef HOWL_IO_INSPECT_TEXT_START_H_
#define HOWL_IO_INSPECT_TEXT_START_H_

#include <filesystem>

#include "io/record_spec.h"

namespace howl {

// The default where the file is no text, or no dialect makes a table of it.
TextDialect GuessDialectOf(const std::filesystem::path& file);

}  // namespace howl

#endif  // HOWL_IO_INSPECT_TEXT_START_H_
