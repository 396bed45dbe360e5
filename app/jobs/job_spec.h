// JOB.yaml: a long command and how a cluster is to run its shards.
//
//   command: trial configs/r228.yaml --cases 200   # without --shard and --out
//   shards: 16
//   slurm: {time: "01:00:00", mem: 2G}              # options of sbatch
//
// The command runs in the folder of the file.
#ifndef HOWL_APP_JOBS_JOB_SPEC_H_
#define HOWL_APP_JOBS_JOB_SPEC_H_

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace howl {

struct JobSpec {
  std::filesystem::path folder;  // of the file, absolute
  std::vector<std::string> words;
  std::optional<std::size_t> shards;
  std::vector<std::pair<std::string, std::string>> slurm;
};

// Throws UserError.
JobSpec LoadJob(const std::filesystem::path& path);

}  // namespace howl

#endif  // HOWL_APP_JOBS_JOB_SPEC_H_
