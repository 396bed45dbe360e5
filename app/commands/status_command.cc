#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <thread>

#include "app/command_line/command.h"
#include "app/jobs/shard_set.h"
#include "app/jobs/slurm.h"
#include "app/jobs/submitted_job.h"
#include "app/process/interruption.h"
#include "app/process/progress_line.h"
#include "io/user_error.h"
#include "io/whole_file.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

constexpr auto kBetweenLooks = std::chrono::seconds(2);
// What Slurm spends on a task, some seconds, is then a few per cent of it.
constexpr double kShortestShard_s = 60.0;

// The argument is an output folder, or a job whose output folder is meant.
fs::path FolderOf(const Options& options) {
  std::error_code ignored;
  return fs::is_regular_file(options.config, ignored) ? options.out : options.config;
}

std::string LastLine(const fs::path& path) {
  std::istringstream lines(ReadWholeFile(path).value_or(""));
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

std::string CountText(const std::vector<std::size_t>& shards, const char* what) {
  if (shards.empty()) return "";
  return ", " + std::to_string(shards.size()) + " " + what + " (" + ListOf(shards) + ")";
}

void PrintMissing(const fs::path& out, const SubmittedJob& job, const ShardStates& states) {
  std::map<std::size_t, EndedTask> ended;
  for (const std::string& array : job.arrays) {
    for (const auto& [index, task] : EndedTasks(array)) ended[index] = task;
  }
  for (const std::size_t index : states.missing) {
    const auto task = ended.find(index);
    const std::string state = task == ended.end() ? "ended without a result" : task->second.state;
    const std::string last = LastLine(LogPath(out, index));
    std::printf("  %zu: %s%s%s\n", index, state.c_str(), last.empty() ? "" : ": ", last.c_str());
  }
  double seconds = 0.0;
  double count = 0.0;
  for (const std::size_t index : states.there) {
    const auto task = ended.find(index);
    if (task == ended.end()) continue;
    seconds += task->second.seconds;
    count += 1.0;
  }
  if (count > 0.0 && seconds / count < kShortestShard_s) {
    std::printf("a shard takes %.0f s: fewer of them would cost less\n", seconds / count);
  }
}

void PrintMerge(const fs::path& out, const SubmittedJob& job, const ShardStates& states) {
  const auto queued = QueuedTasks(job.merge);
  if (!queued.empty()) {
    std::printf("merge: %s\n", queued.begin()->second == "PENDING" ? "waiting" : "running");
    return;
  }
  const std::string last = LastLine(LogPath(out, 0));
  const std::string said = last.empty() ? "" : ": " + last;
  std::printf("merge: ended%s\n", said.c_str());
  if (!states.missing.empty()) std::printf("howl submit, run again, submits what is missing\n");
}

int RunStatusCommand(const Options& options) {
  const fs::path out = fs::absolute(FolderOf(options)).lexically_normal();
  const std::optional<SubmittedJob> job = ReadJob(out);
  if (!job) {
    throw UserError(JobPath(out).string(), 0, "",
                    "is not there, expected the output folder of howl submit");
  }
  WatchForInterruption();
  ShardStates states = StatesOf(out, *job);
  if (options.Has("--follow")) {
    ProgressLine progress(job->CommandName(), options.quiet);
    while (!(states.running.empty() && states.waiting.empty()) && !IsInterrupted()) {
      progress.Show(states.there.size(), job->shards);
      std::this_thread::sleep_for(kBetweenLooks);
      states = StatesOf(out, *job);
    }
    while (!QueuedTasks(job->merge).empty() && !IsInterrupted()) {
      std::this_thread::sleep_for(kBetweenLooks);
    }
  }
  if (!options.quiet) {
    std::printf("%s: %zu shards, %zu there%s%s%s\n", job->CommandName().c_str(), job->shards,
                states.there.size(), CountText(states.running, "running").c_str(),
                CountText(states.waiting, "waiting").c_str(),
                CountText(states.missing, "missing").c_str());
    PrintMissing(out, *job, states);
    PrintMerge(out, *job, states);
  }
  return states.missing.empty() ? kDone : kNegativeAnswer;
}

}  // namespace

Command StatusCommand() {
  return {"status",
          "how far the shards are that howl submit gave to Slurm",
          "Reads FOLDER/shards and Slurm's queue: how many shards are there, running, waiting or\n"
          "missing, and why. Exits with 1 where some are missing that nobody runs.",
          {{"--follow", "", "stay until none is in the queue, with a line of progress"}},
          RunStatusCommand,
          false,
          "FOLDER"};
}

}  // namespace howl
