#include "app/jobs/submitted_job.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/jobs/shard.h"
#include "app/jobs/slurm.h"
#include "io/json_text.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kJobSchema = "howl.job/1";

// A job's number is a word of a command line of Slurm's: what could be an option is none.
bool IsNumberOfSlurm(const std::string& text) {
  return std::ranges::all_of(
      text, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.'; });
}

}  // namespace

fs::path JobPath(const fs::path& out) { return ShardFolder(out) / "job.json"; }

fs::path LogPath(const fs::path& out, std::size_t index) {
  return ShardFolder(out) / "log" / ((index == 0 ? "merge" : std::to_string(index)) + ".txt");
}

std::optional<SubmittedJob> ReadJob(const fs::path& out) {
  const std::optional<std::string> text = ReadWholeFile(JobPath(out));
  if (!text) return std::nullopt;
  try {
    const Json json = ParseJson<Json>(*text);
    if (json.at("schema") != kJobSchema) throw std::invalid_argument("schema");
    SubmittedJob job{
        json.at("folder").get<std::string>(), json.at("command").get<std::vector<std::string>>(),
        json.at("shards").get<std::size_t>(), json.at("arrays").get<std::vector<std::string>>(),
        json.at("merge").get<std::string>()};
    if (job.words.empty()) throw std::invalid_argument("command");
    // Each shard is looked for by its name.
    if (job.shards < 1 || job.shards > kMostShards) throw std::invalid_argument("shards");
    if (!std::ranges::all_of(job.arrays, IsNumberOfSlurm) || !IsNumberOfSlurm(job.merge)) {
      throw std::invalid_argument("arrays");
    }
    return job;
  } catch (const std::exception&) {
    throw UserError(JobPath(out).string(), 0, "",
                    std::string("is damaged, expected the schema ") + kJobSchema +
                        ": remove it and submit again");
  }
}

void WriteJob(const fs::path& out, const SubmittedJob& job) {
  const Json json = {{"schema", kJobSchema}, {"command", job.words}, {"folder", job.folder},
                     {"shards", job.shards}, {"arrays", job.arrays}, {"merge", job.merge}};
  WriteWholeFile(JobPath(out), JsonText(json, 2) + "\n");
}

ShardStates StatesOf(const fs::path& out, const SubmittedJob& job) {
  // The queue is read first: a shard that ends in between is then there.
  std::map<std::size_t, std::string> queued;
  for (const std::string& array : job.arrays) queued.merge(QueuedTasks(array));
  ShardStates states;
  for (std::size_t index = 1; index <= job.shards; ++index) {
    std::error_code ignored;
    const auto task = queued.find(index);
    if (fs::exists(ShardPath(out, job.CommandName(), {index, job.shards}), ignored)) {
      states.there.push_back(index);
    } else if (task == queued.end()) {
      states.missing.push_back(index);
    } else if (task->second == "PENDING" || task->second.starts_with("REQUEUE")) {
      states.waiting.push_back(index);
    } else {
      states.running.push_back(index);
    }
  }
  return states;
}

}  // namespace howl
