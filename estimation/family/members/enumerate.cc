#include "estimation/family/members/enumerate.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "estimation/family/members/sample.h"
#include "estimation/family/members/transfer_starts.h"
#include "estimation/parallel.h"

namespace howl {
namespace {

constexpr std::size_t kChunk = 256;        // members a unit of work
constexpr std::size_t kAttemptsPer = 400;  // attempts a member before a unit gives up

Enumeration EnumerateByChains(const FamilyProblem& problem, std::size_t count, std::uint64_t seed,
                              int threads) {
  Enumeration result;
  result.counts.requested = count;
  SampleOptions sampling{.count = count, .burn_in = 50, .seed = seed, .threads = threads};
  result.members = SampleMembers(problem, sampling).members;
  result.counts.drawn = result.counts.complete = result.counts.members = result.members.size();
  return result;
}

}  // namespace

Enumeration EnumerateMembers(const FamilyProblem& problem, std::size_t count, std::uint64_t seed,
                             int threads) {
  if (count > 0 && NeedsTransferStarts(problem)) {
    return EnumerateByChains(problem, count, seed, threads);
  }
  return EnumerateMembers(problem, MemberDrawer(problem), count, seed, threads);
}

Enumeration EnumerateMembers(const FamilyProblem& problem, const MemberDrawer& drawer,
                             std::size_t count, std::uint64_t seed, int threads) {
  if (count > 0 && NeedsTransferStarts(problem)) {
    return EnumerateByChains(problem, count, seed, threads);
  }
  Enumeration result;
  result.counts.requested = count;
  if (!drawer.HasSupport() || count == 0) return result;
  const std::size_t units = (count + kChunk - 1) / kChunk;
  std::vector<Enumeration> parts(units);
  RunUnits(units, threads, [&](std::size_t unit) {
    Enumeration& part = parts[unit];
    const std::size_t wanted = std::min(kChunk, count - unit * kChunk);
    part.members.reserve(wanted);
    UnitRandom random(seed, unit + 1);
    Member models;
    while (part.members.size() < wanted && part.counts.drawn < wanted * kAttemptsPer) {
      bool complete = false;
      ++part.counts.drawn;
      const bool member = drawer.Draw(random, models, complete);
      if (complete) ++part.counts.complete;
      if (member) part.members.push_back(models);
    }
  });
  result.members.reserve(count);
  for (Enumeration& part : parts) {
    result.counts.drawn += part.counts.drawn;
    result.counts.complete += part.counts.complete;
    std::move(part.members.begin(), part.members.end(), std::back_inserter(result.members));
  }
  result.counts.members = result.members.size();
  return result;
}

Enumeration EnumerateMembers(const std::vector<Experiment>& experiments, const ModelSpec& model,
                             const MembershipTest& test, std::size_t count, std::uint64_t seed,
                             int threads) {
  return EnumerateMembers(
      FamilyProblem{.experiments = experiments, .model = model, .test = test, .domain = {}}, count,
      seed, threads);
}

}  // namespace howl
