#include "app/jobs/slurm.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>

#include "app/process/child_process.h"
#include "io/user_error.h"

namespace howl {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> FindProgram(const std::string& name) {
  const char* const path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe)
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    if (access(file.c_str(), X_OK) == 0) return file.string();
  }
  return std::nullopt;
}

ChildResult RunSlurm(const std::string& program, const std::vector<std::string>& flags) {
  const std::optional<std::string> path = FindProgram(program);
  if (!path) {
    throw UserError(program, 0, "",
                    "is not on this machine, expected Slurm; without it, shards are run by hand or "
                    "by GNU parallel");
  }
  std::vector<std::string> words = {*path};
  words.insert(words.end(), flags.begin(), flags.end());
  return RunChild(words, "");
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

// Of "12_3" the 3, of "12" the 0; no value for "12_[4-9]" and "12_3.batch".
std::optional<std::size_t> IndexOf(const std::string& task) {
  const std::size_t bar = task.find('_');
  if (bar == std::string::npos) return 0;
  const std::string index = task.substr(bar + 1);
  if (index.empty() || index.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  return std::stoul(index);
}

}  // namespace

std::string Submit(const SlurmRequest& request) {
  std::vector<std::string> flags = request.flags;
  flags.emplace_back("--parsable");
  flags.push_back(request.script);
  const ChildResult result = RunSlurm("sbatch", flags);
  const std::string answer = FirstLine(result.out);
  if (result.status != 0 || answer.empty()) {
    throw UserError("sbatch", 0, "", "refuses: " + FirstLine(result.err));
  }
  return answer.substr(0, answer.find(';'));  // on several clusters: number;cluster
}

std::map<std::size_t, std::string> QueuedTasks(const std::string& job) {
  if (job.empty()) return {};  // squeue would list everybody's
  const ChildResult result =
      RunSlurm("squeue", {"--noheader", "--array", "--jobs=" + job, "--format=%i %T"});
  std::map<std::size_t, std::string> tasks;
  // A job that has left the queue long ago is unknown to squeue, which then fails.
  std::istringstream lines(result.status == 0 ? result.out : "");
  for (std::string task, state; lines >> task >> state;) {
    if (const auto index = IndexOf(task)) tasks[*index] = state;
  }
  return tasks;
}

void CancelWaiting(const std::string& job) { RunSlurm("scancel", {"--state=PENDING", job}); }

std::map<std::size_t, EndedTask> EndedTasks(const std::string& job) {
  std::map<std::size_t, EndedTask> tasks;
  if (!FindProgram("sacct")) return tasks;
  const ChildResult result =
      RunSlurm("sacct", {"--noheader", "--parsable2", "--allocations", "--jobs=" + job,
                         "--format=JobID,State,ElapsedRaw"});
  std::istringstream lines(result.status == 0 ? result.out : "");
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string task, state, seconds;
    std::getline(cells, task, '|');
    std::getline(cells, state, '|');
    std::getline(cells, seconds, '|');
    // "CANCELLED by 1000"
    const auto index = IndexOf(task);
    if (index) tasks[*index] = {state.substr(0, state.find(' ')), std::atof(seconds.c_str())};
  }
  return tasks;
}

}  // namespace howl
