#include "app/jobs/shard_set.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "app/jobs/shard.h"
#include "io/json_text.h"
#include "io/user_error.h"

namespace howl {
namespace {

namespace fs = std::filesystem;
std::vector<fs::path> FindShards(const fs::path& out) {
  std::vector<fs::path> paths;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(ShardFolder(out), ignored)) {
    if (entry.path().extension() == ".shard") paths.push_back(entry.path());
  }
  std::ranges::sort(paths);
  return paths;
}

nlohmann::json ParseHeader(const fs::path& path, const std::string& header) {
  nlohmann::json parsed = ParseJsonOrNone<nlohmann::json>(header);
  const bool is_shard =
      parsed.is_object() && parsed.contains("schema") && parsed["schema"] == "howl.shard/1" &&
      parsed.contains("command") && parsed["command"].is_string() && parsed.contains("config") &&
      parsed["config"].is_string() && parsed.contains("options") && parsed["options"].is_object() &&
      parsed.contains("seed") && parsed["seed"].is_number_unsigned() &&
      parsed.contains("program") && parsed["program"].is_string() &&
      parsed.contains("inputs_sha256") && parsed["inputs_sha256"].is_string() &&
      parsed.contains("shards") && parsed["shards"].is_number_unsigned() &&
      parsed.contains("shard") && parsed["shard"].is_number_unsigned();
  const auto is_text = [](const nlohmann::json& value) { return value.is_string(); };
  const bool is_whole = is_shard && std::ranges::all_of(parsed["options"], is_text) &&
                        parsed["shards"] <= kMostShards;
  if (!is_whole) throw UserError(path.string(), 1, "", "no shard, expected one of howl.shard/1");
  return parsed;
}

// The first shard says what the job is; the others must agree.
void RequireSameJob(const fs::path& path, const nlohmann::json& header, const fs::path& first_path,
                    const nlohmann::json& first) {
  for (const auto& [key, value] : first.items()) {
    if (key == "shard" || header.value(key, nlohmann::json()) == value) continue;
    throw UserError(path.string(), 1, key,
                    "is " + header.value(key, nlohmann::json()).dump() + ", expected " +
                        value.dump() + " as in " + first_path.filename().string() +
                        ": it is a shard of another job");
  }
}

void Join(const fs::path& path, const Units& found, Units& all) {
  for (const auto& [key, bytes] : found) {
    const auto [place, is_new] = all.try_emplace(key, bytes);
    if (is_new || place->second == bytes) continue;
    throw UserError(path.string(), 0, key,
                    "is not what another shard has, expected the same: remove it and run it again");
  }
}

ShardSet SetOf(const Options& merge, const nlohmann::json& header) {
  ShardSet set;
  set.command = header.at("command").get<std::string>();
  set.program = header.at("program").get<std::string>();
  set.inputs_sha256 = header.at("inputs_sha256").get<std::string>();
  set.count = header.at("shards").get<std::size_t>();
  set.options = merge;
  set.options.config = header.at("config").get<std::string>();
  set.options.files = {set.options.config};
  set.options.seed = header.at("seed").get<std::uint64_t>();
  set.options.own = header.at("options").get<std::map<std::string, std::string>>();
  for (std::size_t index = 1; index <= set.count; ++index) set.missing.push_back(index);
  return set;
}

// Adds a shard to the set of its job.
void AddShard(const fs::path& path, StoredUnits stored, const nlohmann::json& header,
              ShardSet& set) {
  const auto index = header.at("shard").get<std::size_t>();
  if (!IsWhole(stored) || index < 1 || index > set.count) {
    throw UserError(path.string(), 0, "",
                    "is damaged, expected a whole shard: remove it and run it again");
  }
  std::erase(set.missing, index);
  stored.units.erase(kCountKey);
  Join(path, stored.units, set.units);
}

}  // namespace

std::vector<ShardSet> ReadShards(const Options& merge) {
  struct Job {
    fs::path path;  // of its first shard
    nlohmann::json header;
    ShardSet set;
  };
  std::map<std::string, Job> jobs;  // by the command
  for (const fs::path& path : FindShards(merge.out)) {
    StoredUnits stored = ReadUnits(path);
    const nlohmann::json header = ParseHeader(path, stored.header);
    const auto [job, is_first] = jobs.try_emplace(header.at("command").get<std::string>());
    if (is_first) job->second = {path, header, SetOf(merge, header)};
    RequireSameJob(path, header, job->second.path, job->second.header);
    AddShard(path, std::move(stored), header, job->second.set);
  }
  if (jobs.empty()) {
    throw UserError(ShardFolder(merge.out).string(), 0, "",
                    "has no shard, expected the output folder of a command with --shard");
  }
  std::vector<ShardSet> sets;
  sets.reserve(jobs.size());
  for (auto& [command, job] : jobs) sets.push_back(std::move(job.set));
  return sets;
}

std::string ListOf(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
    if (last > i) text += (last > i + 1 ? " to " : ", ") + std::to_string(numbers[last]);
    i = last + 1;
  }
  return text;
}

}  // namespace howl
