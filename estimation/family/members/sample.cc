#include "estimation/family/members/sample.h"

#include <algorithm>
#include <iterator>

#include "estimation/family/members/convergence.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/member_spread.h"
#include "estimation/family/members/slice_sampler.h"
#include "estimation/family/members/transfer_starts.h"
#include "estimation/parallel.h"

namespace howl {

MemberSample SampleMembers(const FamilyProblem& problem, const SampleOptions& options) {
  constexpr std::size_t kProbes = 128;
  MemberSample sample;
  const SampleChart chart(problem);
  if (!chart.IsSupported() || options.count == 0) return sample;
  const std::size_t chains = std::max<std::size_t>(1, options.chains);
  Enumeration starts;
  if (!options.starts.empty()) {
    starts.members = options.starts;
  } else if (NeedsTransferStarts(problem)) {
    starts.members = TransferStarts(problem, 4 * chains, options.seed + 1, options.threads);
  } else {
    starts =
        EnumerateMembers(problem, std::max(kProbes, chains), options.seed + 1, options.threads);
  }
  if (starts.members.empty()) return sample;
  std::vector<SampleState> states(1);
  for (const Member& member : starts.members) {
    if (chart.FromMember(member, states.back())) states.emplace_back();
  }
  states.pop_back();
  if (states.empty()) return sample;
  const SliceSampler sampler(chart, states);
  // Starts that are far from each other.
  const std::vector<std::size_t> spread = SpreadMembers(starts.members, chains);
  const std::size_t thin = options.thin > 0 ? options.thin
                                            : (problem.HasTransfer() ? 12
                                               : chart.TwoModes()    ? 4
                                                                     : 8);
  const std::size_t length = (options.count + chains - 1) / chains;
  std::vector<std::vector<Member>> drawn(chains);
  std::vector<std::size_t> rejected(chains, 0);
  RunUnits(chains, options.threads, [&](std::size_t chain) {
    UnitRandom random(options.seed, 0x200000 + chain);
    SampleState state;
    bool started = chart.FromMember(starts.members[spread[chain % spread.size()]], state);
    for (std::size_t k = 0; !started && k < starts.members.size(); ++k) {
      started = chart.FromMember(starts.members[k], state);
    }
    if (!started) return;
    for (std::size_t sweep = 0; sweep < options.burn_in; ++sweep) sampler.Sweep(random, state);
    drawn[chain].resize(length);
    for (Member& member : drawn[chain]) {
      for (int tries = 0; tries < 8; ++tries) {
        for (std::size_t sweep = 0; sweep < thin; ++sweep) sampler.Sweep(random, state);
        chart.ToMember(state, random, member);
        if (Holds(problem, member)) break;
        ++rejected[chain];
      }
    }
  });
  drawn.erase(std::remove_if(drawn.begin(), drawn.end(), [](const auto& d) { return d.empty(); }),
              drawn.end());
  if (drawn.empty()) return sample;
  SampleDiagnostics& diagnostics = sample.diagnostics;
  for (const std::size_t count : rejected) diagnostics.rejected += count;
  diagnostics.effective_sample_size = static_cast<double>(length * drawn.size());
  if (length >= 4) {
    std::vector<std::vector<double>> series(drawn.size(), std::vector<double>(length));
    for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
      for (std::size_t k = 0; k < kModelParameters; ++k) {
        for (std::size_t chain = 0; chain < drawn.size(); ++chain) {
          for (std::size_t row = 0; row < length; ++row) {
            series[chain][row] = Parameter(drawn[chain][row][i], k);
          }
        }
        const Convergence convergence = AssessConvergence(series);
        diagnostics.effective_sample_size =
            std::min(diagnostics.effective_sample_size, convergence.effective_sample_size);
        diagnostics.split_r_hat = std::max(diagnostics.split_r_hat, convergence.split_r_hat);
      }
    }
  }
  for (std::vector<Member>& chain : drawn) {
    std::move(chain.begin(), chain.end(), std::back_inserter(sample.members));
  }
  sample.members.resize(std::min(sample.members.size(), options.count));
  std::vector<Member> probes(starts.members.begin(),
                             starts.members.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                          kProbes, starts.members.size())));
  diagnostics.largest_hole = LargestHole(sample.members, probes);
  return sample;
}

}  // namespace howl
