#include <sys/stat.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "app/command_line/command.h"
#include "app/jobs/job_spec.h"
#include "app/jobs/shard.h"
#include "app/jobs/shard_set.h"
#include "app/jobs/slurm.h"
#include "app/jobs/submitted_job.h"
#include "app/process/child_process.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShardsOption = "--shards";

// For the shell.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text)
    quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

std::string ShardScript(const SubmittedJob& job, const fs::path& out) {
  std::string text = "#!/bin/sh\nexec " + Quoted(ThisProgram().string());
  for (const std::string& word : job.words) text += " " + Quoted(word);
  return text + " --out " + Quoted(out.string()) +
         " --threads \"${SLURM_CPUS_PER_TASK:-1}\" --shard \"$SLURM_ARRAY_TASK_ID/" +
         std::to_string(job.shards) + "\" --quiet\n";
}

std::string MergeScript(const fs::path& out) {
  return "#!/bin/sh\nexec " + Quoted(ThisProgram().string()) + " merge " + Quoted(out.string()) +
         " --quiet\n";
}

std::string WriteScript(const fs::path& path, const std::string& text) {
  WriteWholeFile(path, text);
  chmod(path.c_str(), S_IRWXU);
  return path.string();
}

std::string Joined(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const std::size_t number : numbers)
    text += (text.empty() ? "" : ",") + std::to_string(number);
  return text;
}

SlurmRequest RequestOf(const JobSpec& spec, const SubmittedJob& job, const std::string& log,
                       const std::string& script) {
  SlurmRequest request{{"--job-name=howl-" + job.CommandName(), "--requeue",
                        "--chdir=" + job.folder.string(), "--output=" + log, "--open-mode=append"},
                       script};
  for (const auto& [name, value] : spec.slurm) request.flags.push_back("--" + name + "=" + value);
  return request;
}

SubmittedJob JobOf(const JobSpec& spec, const Options& options, const fs::path& out) {
  SubmittedJob job{spec.folder, spec.words, spec.shards.value_or(0), {}, ""};
  if (const auto asked = options.Count(kShardsOption, 1, 100'000)) {
    job.shards = static_cast<std::size_t>(*asked);
  }
  if (job.shards == 0) {
    throw UserError(options.config.string(), 0, "shards",
                    "is missing, expected how many shards, here or as --shards N");
  }
  const std::optional<SubmittedJob> before = ReadJob(out);
  if (!before) return job;
  if (before->words != job.words || before->shards != job.shards || before->folder != job.folder) {
    throw UserError(JobPath(out).string(), 0, "",
                    "is of another command or number of shards, expected the same, or another "
                    "--out");
  }
  return *before;
}

int RunSubmitCommand(const Options& options) {
  const fs::path out = fs::absolute(options.out).lexically_normal();
  const JobSpec spec = LoadJob(options.config);
  SubmittedJob job = JobOf(spec, options, out);
  const ShardStates states = StatesOf(out, job);
  if (states.missing.empty()) {
    std::printf("nothing to submit: of %zu shards %zu are there, the others in the queue\n",
                job.shards, states.there.size());
    return kDone;
  }
  fs::create_directories(LogPath(out, 0).parent_path());
  const fs::path folder = ShardFolder(out);
  const std::string shard_log = (folder / "log" / "%a.txt").string();
  SlurmRequest array =
      RequestOf(spec, job, shard_log, WriteScript(folder / "shard.sh", ShardScript(job, out)));
  array.flags.push_back("--array=" + Joined(states.missing));
  job.arrays.push_back(Submit(array));
  // It is written before the merge is submitted, so that no shard is ever submitted twice.
  const std::string merge_before = job.merge;
  WriteJob(out, job);
  SlurmRequest merge = RequestOf(spec, job, LogPath(out, 0).string(),
                                 WriteScript(folder / "merge.sh", MergeScript(out)));
  std::string after = "--dependency=afterany";
  for (const std::string& each : job.arrays) after += ":" + each;
  merge.flags.push_back(after);
  job.merge = Submit(merge);
  WriteJob(out, job);
  // The merge of an earlier submission would find shards missing.
  if (!merge_before.empty()) CancelWaiting(merge_before);
  if (!options.quiet) {
    std::printf("submitted: shards %s of %zu as job %s, their merge as job %s\n",
                ListOf(states.missing).c_str(), job.shards, job.arrays.back().c_str(),
                job.merge.c_str());
    std::printf("howl status %s says how far they are\n", options.out.c_str());
  }
  return kDone;
}

}  // namespace

Command SubmitCommand() {
  return {"submit",
          "give the shards of a long job to Slurm, or those of them that are missing",
          "JOB.yaml has the command (trial, diagnose --bootstrap, family, campaign), the number\n"
          "of shards, and options of sbatch. Submits an array of the shards that are neither\n"
          "there nor in the queue, requeued where a node fails, and a merge that runs after\n"
          "them. Submitted again, it submits what is missing.",
          {{kShardsOption, "N", "how many shards (default: the job's `shards`)"}},
          RunSubmitCommand,
          false,
          "JOB"};
}

}  // namespace howl
