#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "app/command_line/command.h"
#include "app/command_line/command_line.h"
#include "app/command_line/negative_answer.h"
#include "app/jobs/output_claim.h"
#include "app/jobs/shard.h"
#include "app/jobs/shard_set.h"
#include "app/jobs/unit_store.h"
#include "io/report/run_file.h"
#include "io/user_error.h"

namespace howl {
namespace {

const Command& ShardedCommand(const ShardSet& set) {
  const Command& command = FindCommand(set.command);
  if (!command.sharding) {
    throw UserError(ShardFolder(set.options.out).string(), 0, "command",
                    set.command + " cannot be run in shards");
  }
  return command;
}

// Units of another program, or of inputs that have changed since, are none of this job.
void RequireSameInputs(const ShardSet& set, const Sharding& sharding) {
  if (set.program != ProgramIdentity()) {
    throw UserError(ShardFolder(set.options.out).string(), 0, "program",
                    "is " + set.program + ", but this is " + ProgramIdentity() +
                        ", expected the program that ran the shards");
  }
  if (set.inputs_sha256 != sharding.inputs_sha256(set.options)) {
    throw UserError(
        set.options.config.string(), 0, "",
        "or what it reads has changed since the shards ran, expected them as they were");
  }
}

std::string MissingText(const ShardSet& set) {
  return ShardFolder(set.options.out).string() + ": " + std::to_string(set.missing.size()) +
         " of " + std::to_string(set.count) + " shards of " + set.command +
         " are missing: " + ListOf(set.missing);
}

int MergeOne(ShardSet set) {
  const Command& command = ShardedCommand(set);
  const Sharding& sharding = *command.sharding;
  RequireSameInputs(set, sharding);
  if (!sharding.table_option.empty()) {
    set.options.own[sharding.table_option] = "";
  } else if (!set.missing.empty()) {
    throw NegativeAnswer(MissingText(set));
  }
  sharding.adopt(set.options, set.units);
  const int status = command.run(set.options);
  if (command.writes_results)
    NoteRun(set.options.out, set.options.config, command.name, set.options.seed);
  if (!set.missing.empty()) throw NegativeAnswer(MissingText(set));
  return status;
}

int RunMergeCommand(const Options& merge) {
  Options at = merge;
  if (!at.out_is_given) at.out = merge.config;
  // Of a folder that is not there ReadShards says so.
  std::optional<OutputClaim> claim;
  if (std::filesystem::is_directory(ShardFolder(at.out)))
    claim.emplace(at.out, "merge", std::nullopt);
  int status = kDone;
  for (ShardSet& set : ReadShards(at)) status = std::max(status, MergeOne(std::move(set)));
  return status;
}

}  // namespace

Command MergeCommand() {
  return {
      "merge",
      "join the shards of a long job to the result that one machine would have",
      "Reads FOLDER/shards, checks that all are of one job (command, options, program, inputs)\n"
      "and whole, and runs the command on what they found, in FOLDER. Run it where the shards\n"
      "were run. Shards that are missing are named (exit 1); of a campaign, the table then has\n"
      "those rigs that are there. Of other jobs' shards nothing is taken (exit 2).",
      {},
      RunMergeCommand,
      false,
      "FOLDER"};
}

}  // namespace howl
