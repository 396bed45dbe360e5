// Slurm, through its own programs: sbatch, squeue, scancel, sacct.
#ifndef HOWL_APP_JOBS_SLURM_H_
#define HOWL_APP_JOBS_SLURM_H_

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace howl {

struct SlurmRequest {
  std::vector<std::string> flags;  // --name=value
  std::string script;              // path
};

// Returns the job's number. Throws UserError with sbatch's message where it refuses, and where
// there is no Slurm.
std::string Submit(const SlurmRequest& request);

// The tasks of a job that are in the queue: state (PENDING, RUNNING, ...) by index; a job without
// an array has the index 0. Empty where the job has left the queue.
std::map<std::size_t, std::string> QueuedTasks(const std::string& job);

// Takes what is still waiting of a job from the queue.
void CancelWaiting(const std::string& job);

struct EndedTask {
  std::string state;  // COMPLETED, CANCELLED, TIMEOUT, ...
  double seconds = 0.0;
};
// By index; empty where the cluster keeps no accounts.
std::map<std::size_t, EndedTask> EndedTasks(const std::string& job);

}  // namespace howl

#endif  // HOWL_APP_JOBS_SLURM_H_
