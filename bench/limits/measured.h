// One thing that can be run again and again: what it does is counted in units, and the seconds of
// the processor that it takes are measured.
#ifndef HOWL_BENCH_LIMITS_MEASURED_H_
#define HOWL_BENCH_LIMITS_MEASURED_H_

#include <functional>
#include <string>
#include <vector>

namespace howl::limits {

struct Measured {
  std::string id;
  std::string unit;
  // Prepares one run, whose preparation is not measured. The run gives the units that it did.
  std::function<std::function<double()>()> prepare;
};

// How fast the machine does each kind of thing that the hot loops are made of (machine_peak.cc,
// machine_calls.cc).
std::vector<Measured> ArithmeticPeaks();
std::vector<Measured> CallPeaks();

// The workloads.
std::vector<Measured> SimulateLoads();
std::vector<Measured> EnumerateLoads();
std::vector<Measured> EncloseLoads();
std::vector<Measured> ContractLoads();
std::vector<Measured> LikelihoodLoads();

}  // namespace howl::limits

#endif  // HOWL_BENCH_LIMITS_MEASURED_H_
