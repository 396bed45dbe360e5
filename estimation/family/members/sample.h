// Members drawn uniformly from the family: uniform with respect to the Lebesgue measure of the
// natural parameters that are free, (omega_hz, xi, N, M or M / N, tau_s) of each experiment, a
// shared parameter counting once.
//
// Chains of slice sampling (slice_sampler.h) in coordinates in which the test's conditions are
// bounds (sample_chart.h). Several chains start from different members of an enumeration; where the
// family has parts that no chain crosses between (two modes), R-hat says so.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_SAMPLE_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_SAMPLE_H_

#include <cstdint>
#include <vector>

#include "estimation/family/problem/problem.h"

namespace howl {

struct SampleOptions {
  std::size_t count = 10000;
  std::size_t chains = 8;
  std::size_t burn_in = 200;  // sweeps
  std::size_t thin = 0;       // sweeps a member; 0: 8 with one mode, 4 with two, 12 with transfers
  std::uint64_t seed = 0;
  int threads = 1;
  std::vector<Member> starts;  // of the chains; empty: found by the sampler itself
};

struct SampleDiagnostics {
  double effective_sample_size = 0.0;  // smallest over the parameters
  double split_r_hat = 0.0;            // largest over the parameters; near one when mixed
  // Largest distance from an enumerated member to the nearest drawn one, each parameter in units
  // of its range, divided by the square root of the number of parameters: 0 covered, 1 missed.
  double largest_hole = 0.0;
  std::size_t rejected = 0;  // draws that the falsification test did not confirm (rounding)
};

struct MemberSample {
  std::vector<Member> members;  // chain by chain
  SampleDiagnostics diagnostics;
};

// Empty when no member is found, or for the one unsupported scope (N shared while each experiment
// has its own second mode).
MemberSample SampleMembers(const FamilyProblem& problem, const SampleOptions& options = {});

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_SAMPLE_H_
