#include "app/jobs/job_spec.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <system_error>

#include "app/command_line/command.h"
#include "app/command_line/command_line.h"
#include "app/jobs/shard.h"
#include "io/config/schema/config_cursor.h"
#include "io/config/schema/schema_check.h"
#include "io/config/yaml/config_text.h"
#include "io/config/yaml/yaml_tree.h"
#include "io/user_error.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSpecSchema = R"({
  "type": "object",
  "additionalProperties": false,
  "required": ["command"],
  "properties": {
    "command": {"type": "string", "description": "such as trial configs/r228.yaml --cases 200"},
    "shards": {"type": "integer", "minimum": 1, "maximum": 100000, "description": "how many"},
    "slurm": {"type": "object", "description": "options of sbatch", "additionalProperties": {"type": ["string", "number", "integer"]}}
  }
})";

// What howl submit says to sbatch itself.
constexpr std::string_view kOwnFlags[] = {"array",    "dependency", "output", "error",
                                          "parsable", "chdir",      "wrap",   "requeue"};

std::string CommandsWithShards() {
  std::string names;
  for (const Command& command : Commands()) {
    if (command.sharding) names += (names.empty() ? "" : ", ") + command.name;
  }
  return names;
}

void ReadCommand(const ConfigCursor& root, JobSpec& job) {
  const ConfigCursor command = *root.Find("command");
  std::istringstream in(command.Node().text);
  for (std::string word; in >> word;) job.words.push_back(word);
  if (job.words.empty()) command.Fail("is empty, expected such as trial configs/r228.yaml");
  const auto& all = Commands();
  const auto found = std::ranges::find(all, job.words.front(), &Command::name);
  if (found == all.end() || !found->sharding) {
    command.Fail("\"" + job.words.front() + "\" cannot be run in shards, expected one of " +
                 CommandsWithShards());
  }
  for (const std::string& word : job.words) {
    for (const std::string_view given : {kShardOption, "--out"}) {
      if (word == given || word.starts_with(std::string(given) + "=")) {
        command.Fail("has " + word + ", which howl submit gives itself, expected it without");
      }
    }
  }
  std::error_code ignored;
  if (job.words.size() < 2 || !fs::is_regular_file(job.folder / job.words[1], ignored)) {
    command.Fail("there is no file \"" +
                 (job.words.size() < 2 ? std::string() : (job.folder / job.words[1]).string()) +
                 "\", expected the config after " + job.words.front() +
                 ", relative to the job's folder");
  }
}

}  // namespace

JobSpec LoadJob(const fs::path& path) {
  const std::string file = path.string();
  const LocatedNode tree = ParseYaml(file, ReadConfigText(path));
  if (tree.kind != LocatedNode::Kind::kMapping) {
    throw UserError(file, tree.line, "", "is no job, expected command, shards and slurm");
  }
  CheckSchema(file, tree, nlohmann::json::parse(kSpecSchema));
  const ConfigCursor root(file, tree);
  JobSpec job;
  job.folder = fs::absolute(path).lexically_normal().parent_path();
  ReadCommand(root, job);
  int shards = 0;
  root.Read("shards", shards);
  if (shards > 0) job.shards = static_cast<std::size_t>(shards);
  if (const auto slurm = root.Find("slurm")) {
    for (const LocatedMember& member : slurm->Node().members) {
      if (std::ranges::find(kOwnFlags, member.key) != std::end(kOwnFlags)) {
        slurm->FailAt(member.key, "is given by howl submit itself, expected it without");
      }
      job.slurm.emplace_back(member.key, member.value.text);
    }
  }
  return job;
}

}  // namespace howl
