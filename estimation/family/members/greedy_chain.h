// Two modes whose M (or M / N) is shared: the members that go up the chain of phi with the least xi
// that fits, in a window [v, (1 + spread) v] of omega. See two_mode_tradeoff.h.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_GREEDY_CHAIN_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_GREEDY_CHAIN_H_

#include <cstddef>
#include <limits>
#include <vector>

#include "estimation/family/problem/member_chart.h"
#include "estimation/family/problem/problem.h"

namespace howl {

class GreedyChain {
 public:
  // The problem must outlive the object.
  explicit GreedyChain(const FamilyProblem& problem);

  // Largest xi with the shared value; infinite where none is found.
  double LargestXi(double second) const;
  // Appends members at the extremes for this shared value and window: every xi as low, and as
  // high, as window and chain allow, at each corner of phase and gain.
  void Extremes(double second, double v, std::vector<Member>& members) const;
  // Where the low end v of a window may lie, in Hz.
  Range Windows() const;

  // Of LargestXi.
  static constexpr double kUnreached = std::numeric_limits<double>::infinity();

 private:
  // On the branch where the first mode carries the fundamental: at or below the one-mode solution.
  double Omega(const ExperimentTarget& target, double xi, double phase, double gain,
               double second) const;
  // Lowest and highest omega over the corners of phase and gain.
  Range Reach(const ExperimentTarget& target, double xi, double second) const;
  bool Chain(double second, double v, std::vector<double>& xi) const;
  // The largest xi that fit, down from the highest phi; `low` is from Chain.
  bool ChainDown(double second, double v, const std::vector<double>& low,
                 std::vector<double>& high) const;
  // Phase, gain and loop phase within their tolerances that put omega into the window.
  bool Build(double second, double v, const std::vector<double>& xi, Member& member,
             bool late = false, bool loud = false) const;
  bool BuildOne(std::size_t i, double second, const Range& window, double xi, bool late, bool loud,
                LoopModel& model) const;

  const FamilyProblem& problem_;
  MemberChart chart_;
  const std::vector<ExperimentTarget>& targets_ = chart_.targets;
  std::vector<std::size_t> order_;  // by phi
  Range xi_;
  Range omega_;
  double factor_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_GREEDY_CHAIN_H_
