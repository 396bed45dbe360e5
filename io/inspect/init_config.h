// Writes a config for records that were inspected, with each guess and its reason as a comment.
#ifndef HOWL_IO_INSPECT_INIT_CONFIG_H_
#define HOWL_IO_INSPECT_INIT_CONFIG_H_

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/inspect/record_look.h"

namespace howl {

struct InitOptions {
  std::filesystem::path folder;  // of the config; empty: the working directory
  std::string operating_parameter = "phi";
  std::vector<std::string> values;    // of it, one a file; empty: to be filled in
  std::optional<double> sampling_hz;  // of files that do not tell theirs
};

struct InitConfig {
  std::string text;
  std::vector<std::string> columns;  // for the terminal: one line a guess
  std::size_t left_open = 0;         // places with FILL_IN
};

// Throws UserError for a file that no config can name, or that has no column left for pressure.
InitConfig WriteInitConfig(std::span<const RecordLook> looks, const InitOptions& options);

}  // namespace howl

#endif  // HOWL_IO_INSPECT_INIT_CONFIG_H_
