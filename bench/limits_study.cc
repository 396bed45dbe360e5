// How near the hot loops come to what the machine can do: measures peaks of the machine and the
// workloads in turn, on one thread, and prints what each took, as JSON. bench/limits/limits.py runs
// it, counts the operations of each workload and prints the table of docs/limits.md.
//
//   limits_study [ROUNDS] [ID]     seconds of the processor of each run; ID: this one alone
//   limits_study --once ID         one run, for a counter of instructions: units done
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/limits/measured.h"

namespace howl::limits {

// By its name the counter knows where a run begins and ends.
[[gnu::noinline]] double MeasuredRun(const std::function<double()>& run) {
  const double units = run();
  asm volatile("" : : : "memory");  // no tail call
  return units;
}

namespace {

// Time that this thread ran: what others do meanwhile is not in it, but for their use of caches
// and memory.
double Seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

using Lists = std::vector<Measured> (*)();

std::vector<Measured> Joined(std::initializer_list<Lists> lists) {
  std::vector<Measured> all;
  for (const Lists list : lists) {
    for (Measured& one : list()) all.push_back(std::move(one));
  }
  return all;
}

int RunOnce(const std::vector<Measured>& all, std::string_view id) {
  for (const Measured& one : all) {
    if (one.id != id) continue;
    std::printf("%.17g\n", MeasuredRun(one.prepare()));
    return EXIT_SUCCESS;
  }
  std::fprintf(stderr, "no workload has the name %s\n", std::string(id).c_str());
  return 2;
}

nlohmann::ordered_json Study(const std::vector<Measured>& all, int rounds, std::string_view id) {
  nlohmann::ordered_json out;
  // In turn, so that a slow minute of the machine slows all of them.
  for (int round = -1; round < rounds; ++round) {
    for (const Measured& one : all) {
      if (!id.empty() && one.id != id) continue;
      const std::function<double()> run = one.prepare();
      const double begin = Seconds();
      const double units = MeasuredRun(run);
      const double taken = Seconds() - begin;
      if (round < 0) continue;  // the first of all warms caches up
      nlohmann::ordered_json& row = out[one.id];
      row["unit"] = one.unit;
      row["units"] = units;
      row["seconds_per_unit"].push_back(taken / units);
    }
  }
  return out;
}

}  // namespace
}  // namespace howl::limits

int main(int argc, char** argv) {
  using namespace howl::limits;
  const std::vector<Measured> loads =
      Joined({SimulateLoads, EnumerateLoads, ContractLoads, EncloseLoads, LikelihoodLoads});
  if (argc == 3 && std::string_view(argv[1]) == "--once") return RunOnce(loads, argv[2]);
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  const char* const id = argc > 2 ? argv[2] : "";
  nlohmann::ordered_json out;
  std::vector<Measured> all = Joined({ArithmeticPeaks, CallPeaks});
  const std::size_t peaks = all.size();
  all.insert(all.end(), loads.begin(), loads.end());
  const nlohmann::ordered_json rows = Study(all, rounds, id);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!rows.contains(all[i].id)) continue;
    out[i < peaks ? "peaks" : "loads"][all[i].id] = rows[all[i].id];
  }
  std::printf("%s\n", out.dump(2).c_str());
  return EXIT_SUCCESS;
}
