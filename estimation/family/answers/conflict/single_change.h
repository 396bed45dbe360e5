// The smallest change of one number of an empty family's problem that gives the family a member,
//
//   v* = argmin |v - v_0|   over the v for which the family has a member,
//
// for a limit of the test, for a bound that the user gave a parameter, and for a datum of one
// experiment. A family only grows with a limit or a bound: these are bisected between too tight and
// wide enough. A datum is searched outwards to both sides.
//
// Nothing is claimed that was not found: `pasted` is a short decimal number within one per cent of
// the change beyond v*, and `member` a member of the family with it.
#ifndef HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_SINGLE_CHANGE_H_
#define HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_SINGLE_CHANGE_H_

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimation/family/problem/problem.h"

namespace howl {

enum class ChangeKind { kCondition, kBound, kDatum };

// The data that an experiment states, in the order of kDatumNames. kReliable is whether the
// experiment is reliable, which can only be switched.
enum class Datum { kFrequency, kPhase, kGain, kFlameSlope, kReliable };

// The names in configs.
std::string_view DatumName(Datum datum);

// The one number that is changed.
struct ChangeTarget {
  ChangeKind kind = ChangeKind::kCondition;
  Condition condition = Condition::kGain;
  ParameterKind parameter = ParameterKind::kOmega;  // of a bound
  bool is_upper = false;                            // the bound is the largest value
  std::size_t experiment = 0;                       // of a datum
  Datum datum = Datum::kFrequency;

  // xi_increasing and reliable can only be switched off.
  bool IsSwitch() const {
    return kind == ChangeKind::kCondition ? condition == Condition::kXiIncreasing
                                          : kind == ChangeKind::kDatum && datum == Datum::kReliable;
  }
};

struct SmallestChange {
  ChangeTarget target;
  bool helps = false;                 // this change alone gives a member
  bool searched = true;               // false: there is no way to tell, the change was not tried
  double value = 0.0;                 // now; 1 of a switch
  std::optional<double> needed;       // v*, to a thousandth of the change; none of a switch
  std::optional<double> pasted;       // 0 of a switch
  Member member;                      // of the family with `pasted`
  bool less_is_proved_empty = false;  // one per cent less than `pasted`, of the change
};

// The targets of change: every limit that binds, every bound that the user gave, and every datum
// that the test looks at.
std::vector<ChangeTarget> ChangeTargets(const FamilyProblem& problem);

double ValueNow(const FamilyProblem& problem, const ChangeTarget& target);
FamilyProblem Changed(const FamilyProblem& problem, const ChangeTarget& target, double value);

// The smallest change in an empty family. `known`: members of the family without some of its
// conditions, to start from.
SmallestChange FindSmallestChange(const FamilyProblem& problem, const ChangeTarget& target,
                                  std::span<const Member> known);

// The shortest decimal number between the two.
double ShortestBetween(double a, double b);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_ANSWERS_CONFLICT_SINGLE_CHANGE_H_
