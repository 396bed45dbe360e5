// OUT/shards/job.json, schema howl.job/1: what howl submit gave to Slurm.
#ifndef HOWL_APP_JOBS_SUBMITTED_JOB_H_
#define HOWL_APP_JOBS_SUBMITTED_JOB_H_

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace howl {

struct SubmittedJob {
  std::filesystem::path folder;  // in which the command runs
  std::vector<std::string> words;
  std::size_t shards = 0;
  std::vector<std::string> arrays;  // Slurm's numbers, the last submission last
  std::string merge;                // Slurm's number

  const std::string& CommandName() const { return words.front(); }
};

std::filesystem::path JobPath(const std::filesystem::path& out);
// What shard `index` prints; 0: the merge.
std::filesystem::path LogPath(const std::filesystem::path& out, std::size_t index);

// No value where nothing was submitted. Throws UserError where the file is damaged.
std::optional<SubmittedJob> ReadJob(const std::filesystem::path& out);
void WriteJob(const std::filesystem::path& out, const SubmittedJob& job);

struct ShardStates {
  std::vector<std::size_t> there;  // their files are
  std::vector<std::size_t> running;
  std::vector<std::size_t> waiting;
  std::vector<std::size_t> missing;  // neither there nor in the queue
};
ShardStates StatesOf(const std::filesystem::path& out, const SubmittedJob& job);

}  // namespace howl

#endif  // HOWL_APP_JOBS_SUBMITTED_JOB_H_
