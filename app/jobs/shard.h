// A share of a long job. A job is a list of units of work; shard i of n has the units i - 1,
// i - 1 + n, i - 1 + 2 n, ... of it, runs them in a process of its own, on whatever machine, and
// leaves them in a file of its own:
//
//   OUT/shards/3-of-16.COMMAND.shard
//
// The file appears whole, once the shard has ended; a shard that is stopped keeps what it has
// beside it and goes on from there. howl merge puts the shards' units where an interrupted run of
// the command would have left them, and then runs the command, which goes on from there: so its
// result is that of one machine, byte for byte.
#ifndef HOWL_APP_JOBS_SHARD_H_
#define HOWL_APP_JOBS_SHARD_H_

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "app/command_line/command.h"
#include "app/command_line/options.h"
#include "app/jobs/unit_store.h"

namespace howl {

struct Shard {
  std::size_t index = 1;  // 1 to count
  std::size_t count = 1;

  bool Owns(std::size_t unit) const { return unit % count == index - 1; }
  std::string Name() const;  // 3-of-16
};

// The last unit of a shard's file: how many there are besides, so that a file that was cut at a
// unit's end is not taken for a whole one.
inline constexpr const char* kCountKey = "#units";

inline constexpr std::size_t kMostShards = 100'000;

// The option that every sharded command has.
inline constexpr const char* kShardOption = "--shard";
OptionHelp ShardOption();

// Of --shard; empty without it. Throws UsageError at anything but I/N with 1 <= I <= N.
std::optional<Shard> ShardOf(const Options& options);

std::filesystem::path ShardFolder(const std::filesystem::path& out);
std::filesystem::path ShardPath(const std::filesystem::path& out, const std::string& command,
                                const Shard& shard);
// Where a shard that runs keeps its finished units.
std::filesystem::path ShardPartPath(const std::filesystem::path& out, const std::string& command,
                                    const Shard& shard);

// A shard's header: what determines the job (the command with its options, the program, and
// `inputs_sha256` of all that its units depend on beside), and which shard this is.
std::string ShardHeader(const std::string& command, const Options& options,
                        const std::string& inputs_sha256, const Shard& shard);

// Whether nothing of a shard's file is damaged or cut off.
bool IsWhole(const StoredUnits& stored);

// Whether the shard's file is there and is of this job: then there is nothing left to do. Throws
// UserError where it is another job's.
bool IsShardDone(const std::filesystem::path& out, const std::string& command, const Shard& shard,
                 const std::string& header);

// Writes the shard's file, says so on the terminal.
void FinishShard(const Options& options, const std::string& command, const Shard& shard,
                 const std::string& header, const Units& units);

// The command's own options but --shard, as they would be typed again.
std::string OptionsText(const Options& options);

}  // namespace howl

#endif  // HOWL_APP_JOBS_SHARD_H_
