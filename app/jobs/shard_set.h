// The shards of the jobs that are in a folder.
#ifndef HOWL_APP_JOBS_SHARD_SET_H_
#define HOWL_APP_JOBS_SHARD_SET_H_

#include <filesystem>
#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "app/jobs/unit_store.h"

namespace howl {

struct ShardSet {
  std::string command;
  Options
      options;  // as they were typed for the shards; --out, --threads and --quiet are the merge's
  std::string program;
  std::string inputs_sha256;
  std::size_t count = 0;             // shards of the job
  std::vector<std::size_t> missing;  // ascending
  Units units;                       // of all that are there
};

// A set for each command that left shards here. Throws UserError that names the file where there is
// none, where one is of another job of its command, where one is damaged, and where two have a unit
// in common that differs.
std::vector<ShardSet> ReadShards(const Options& merge);

// "4, 7 to 9"
std::string ListOf(const std::vector<std::size_t>& numbers);

}  // namespace howl

#endif  // HOWL_APP_JOBS_SHARD_SET_H_
