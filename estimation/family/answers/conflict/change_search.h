// The search for the smallest change of one number
// (estimation/family/answers/conflict/single_change.h): the problem as a function of its value, and
// the member found last.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_CHANGE_SEARCH_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_CHANGE_SEARCH_H_

#include <optional>
#include <span>
#include <vector>

#include "estimation/family/answers/conflict/single_change.h"
#include "estimation/family/problem/problem.h"

namespace howl {

// The effort of a search for a member: from the member found last, from more starts, or with draws
// at random.
enum class Effort { kQuick, kUsual, kThorough };

// The known members from which to start; those that pass most conditions come last.
std::span<const Member> LastOf(std::span<const Member> known);

class ChangeSearch {
 public:
  ChangeSearch(const FamilyProblem& problem, const ChangeTarget& target,
               std::span<const Member> known)
      : problem_(problem), target_(target), known_(known), value_(ValueNow(problem, target)) {}

  // True if the family has a member at the value. The member is kept, except where exact windows
  // decide without one.
  bool HasMember(double value, Effort effort = Effort::kUsual);

  // The nearest value of a limit or a bound that has a member, searched from `off`, which has one.
  std::optional<double> NearestOfMonotone();

  // The nearest value of a datum that has a member, searched outwards to both sides until either
  // has one, then back to the edge.
  std::optional<double> NearestOfDatum();

  std::optional<Member> MemberAt(double value) const;
  bool IsEmptyAt(double value) const;

 private:
  // A value so wide that it is as good as no limit, with which the search for members can work.
  double Off() const;
  std::vector<Member> Starts() const;
  double Less(double value, double share) const { return value_ + share * (value - value_); }
  // The limit that the member found at the value would just pass, where that is nearer still.
  double Nearer(double value) const;
  // The nearest displacement between the two shares of the datum, of which the larger has a member.
  double EdgeOfDatum(double sign, double tight, double wide);
  // The first of ever wider values that has a member, by exact windows.
  std::optional<double> WideEnough();
  // The limit that a member of the family without the limit or bound would just pass, or a nearer
  // one that a local search finds from it.
  std::optional<double> FromOff();
  // Bisects between a value that is too tight and one that is wide enough.
  double Bisect(double wide, Effort effort);
  // The least violation of the one condition that local searches reach from members of the family
  // without it. The search has no row for the least loop gain, which is a bound of its own.
  std::optional<double> NearestLocally();
  // The model that comes nearest to being a member, as a start for the changed problems.
  void LeastViolated();
  // A datum moved by a share of its size; degrees by a share of a quarter turn.
  double Displaced(double share) const;

  const FamilyProblem& problem_;
  const ChangeTarget target_;
  const std::span<const Member> known_;
  const double value_;
  std::optional<Member> member_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_CHANGE_SEARCH_H_
