#include "estimation/family/members/transfer_volume.h"

#include <cmath>

#include "estimation/family/local/local_search.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/sample.h"
#include "estimation/family/members/transfer_starts.h"

namespace howl {

namespace {

constexpr double kShare = 0.3;

double LargestDistance(const FamilyProblem& problem, const Member& member) {
  double largest = 0.0;
  for (std::size_t i = 0; i < member.size(); ++i) {
    const auto& ellipsoid = problem.experiments[i].transfer_ellipsoid;
    if (ellipsoid) largest = std::max(largest, TransferDistance(*ellipsoid, member[i]));
  }
  return largest;
}

// Two modes have a finite volume where neither the damping may vanish nor the second mode grow.
bool IsFinite(const FamilyProblem& problem) {
  if (problem.model.modes == 1) return std::isfinite(problem.test.xi_max);
  const ParameterKind second =
      problem.model.second_mode_relative ? ParameterKind::kMOverN : ParameterKind::kM;
  return problem.RangeOf(ParameterKind::kXi).lo > 0.0 && std::isfinite(problem.test.xi_max) &&
         std::isfinite(problem.RangeOf(second).hi);
}

// From a member without the condition, or from the transfers' centres.
std::optional<double> LeastDistance(const FamilyProblem& without, const FamilyProblem& problem) {
  constexpr std::size_t kTried = 4;
  const LocalSearch search(without);
  if (!search.IsSupported()) return std::nullopt;
  FamilyProblem asked = problem;
  asked.test.transfer_distance_max = 1.0;
  const LocalSearch nearest(asked);
  std::vector<Member> starts = EnumerateMembers(without, kTried, 0, 1).members;
  if (const std::optional<Member> centre = search.FromTransfer()) starts.push_back(*centre);
  ConditionSet soft;
  soft.Insert(Condition::kTransfer);
  std::optional<double> least;
  for (const Member& start : starts) {
    const std::optional<LocalSolution> member = search.ReduceViolation(start);
    if (!member || !Holds(without, member->member)) continue;
    const std::optional<LocalSolution> near = nearest.Minimise(member->member, soft);
    if (!near || !Holds(without, near->member)) continue;
    const double distance = LargestDistance(problem, near->member);
    if (!least || distance < *least) least = distance;
  }
  return least;
}

}  // namespace

FamilyProblem WithoutTransfer(const FamilyProblem& problem) {
  FamilyProblem without = problem;
  without.test.transfer_distance_max = std::numeric_limits<double>::infinity();
  return without;
}

TransferVolume MeasureTransferVolume(const FamilyProblem& problem, const VolumeOptions& options) {
  TransferVolume volume;
  for (const Experiment& experiment : problem.experiments) {
    volume.experiments += experiment.transfer_ellipsoid.has_value();
  }
  const FamilyProblem without = WithoutTransfer(problem);
  volume.finite_without = IsFinite(without);
  volume.least_distance = LeastDistance(without, problem);
  const double target = problem.test.transfer_distance_max;
  if (!volume.finite_without || !(volume.least_distance.value_or(0.0) <= target)) return volume;

  SampleOptions sampling{
      .count = 8 * options.population, .seed = options.seed + 17, .threads = options.threads};
  std::vector<Member> members = SampleMembers(without, sampling).members;
  sampling.count = sampling.chains = options.population;
  sampling.burn_in = options.sweeps - 1;
  sampling.thin = 1;
  FamilyProblem level = problem;
  double ln_ratio = 0.0;
  double variance = 0.0;
  for (; volume.levels < options.max_levels && !members.empty(); ++volume.levels) {
    std::vector<std::pair<double, std::size_t>> distances;
    for (std::size_t k = 0; k < members.size(); ++k) {
      distances.emplace_back(LargestDistance(problem, members[k]), k);
    }
    std::sort(distances.begin(), distances.end());
    const auto count = static_cast<double>(distances.size());
    const auto within = [&](double d) {
      return static_cast<std::size_t>(
          std::upper_bound(distances.begin(), distances.end(), std::pair{d, members.size()}) -
          distances.begin());
    };
    const std::size_t wanted =
        std::max<std::size_t>(1, static_cast<std::size_t>(kShare * count)) - 1;
    const double next = std::max(target, distances[wanted].first);
    const std::size_t kept = within(next);
    const double share = static_cast<double>(kept) / count;
    ln_ratio += std::log(share);
    variance += (1.0 - share) / (share * count);
    if (next <= target) {
      volume.ln_ratio = ln_ratio;
      volume.ln_std = std::sqrt(variance);
      ++volume.levels;
      return volume;
    }
    if (!(share < 1.0)) return volume;  // the chains do not move
    level.test.transfer_distance_max = next;
    sampling.starts.clear();
    for (std::size_t k = 0; k < kept; ++k) sampling.starts.push_back(members[distances[k].second]);
    sampling.seed = options.seed + 1000 * (volume.levels + 1);
    members = SampleMembers(level, sampling).members;
  }
  return volume;
}

}  // namespace howl
