// The search for the smallest change of one number (estimation/family/answers/single_change.h): the
// problem as a function of its value, and the member found last.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_CHANGE_SEARCH_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_CHANGE_SEARCH_H_

#include <optional>
#include <span>
#include <vector>

#include "estimation/family/answers/single_change.h"
#include "estimation/family/problem/problem.h"

namespace howl {

// Of a search for a member: from the member found last, from more starts, with draws at random.
enum class Effort { kQuick, kUsual, kThorough };

// Of the members known those to start from: the ones that passed most conditions come last.
std::span<const Member> LastOf(std::span<const Member> known);

class ChangeSearch {
 public:
  ChangeSearch(const FamilyProblem& problem, const ChangeTarget& target,
               std::span<const Member> known)
      : problem_(problem), target_(target), known_(known), value_(ValueNow(problem, target)) {}

  // Whether the family has a member at the value. Keeps the member, but exact windows decide
  // without one.
  bool HasMember(double value, Effort effort = Effort::kUsual);

  // Of a limit or a bound: the nearest value that has a member, from `off`, which has one.
  std::optional<double> NearestOfMonotone();

  // Of a datum: outwards to both sides until either has a member, then back to the edge.
  std::optional<double> NearestOfDatum();

  std::optional<Member> MemberAt(double value) const;
  bool IsEmptyAt(double value) const;

 private:
  // A value for "as good as none", that the search for members can work with.
  double Off() const;
  std::vector<Member> Starts() const;
  double Less(double value, double share) const { return value_ + share * (value - value_); }
  // What the member found at the value would pass, where that is nearer still.
  double Nearer(double value) const;
  // The nearest displacement between the two shares of the datum, of which the larger has a member.
  double EdgeOfDatum(double sign, double tight, double wide);
  // The first of ever wider values that has a member, by exact windows.
  std::optional<double> WideEnough();
  // What a member without the limit or bound would pass, or what a local search makes of it.
  std::optional<double> FromOff();
  // Between too tight and wide enough.
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

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_CHANGE_SEARCH_H_
