// Reads a config: by LoadConfig, which stops at the first mistake, or by ReadConfigOn, which finds
// them all.
#ifndef HOWL_IO_CONFIG_READING_CONFIG_READING_H_
#define HOWL_IO_CONFIG_READING_CONFIG_READING_H_

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "io/config/config.h"
#include "io/user_error.h"

namespace howl {

// A config that is read on after its mistakes.
struct ConfigReading {
  std::vector<UserError> mistakes;  // in the order of the file where they have lines
  // Absent where the mistakes leave nothing to read. Experiments with a mistake are left out; of a
  // section with one, the defaults hold.
  std::optional<Config> config;
  std::size_t experiments = 0;   // with those left out
  bool points_are_known = true;  // false: operating parameters are still to be filled in
};

ConfigReading ReadConfigOn(const std::filesystem::path& path);

// The loops that a command can take: the paper's, or richer ones that records alone can show
// (Config::record_loop).
enum class LoopsTaken : std::uint8_t { kPapers, kAny };

// Throws UserError at the first mistake, in the order of the file's lines for what the schema
// states; then come the rules that join several keys.
Config LoadConfig(const std::filesystem::path& path, LoopsTaken loops = LoopsTaken::kPapers);

}  // namespace howl

#endif  // HOWL_IO_CONFIG_READING_CONFIG_READING_H_
