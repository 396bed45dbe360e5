// The smallest size of an effect that is found with 90 % probability. At severity x (outcome.h)
//
//   P(found) = (1 - lapse) / (1 + exp(-(x - x50) / width)),   lapse 1 %
//
// with x50 of the effect's own and a width that all effects share, from a uniform prior on both by
// summation over a grid.
#ifndef HOWL_TRIAL_POWER_H_
#define HOWL_TRIAL_POWER_H_

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trial/outcome.h"

namespace howl {

struct EffectPower {
  std::string effect;
  int cases = 0;
  int found = 0;
  // Severity at 90 %: posterior median and 90 % interval.
  double severity = 0.0;
  double severity_low = 0.0;
  double severity_high = 0.0;
  // Sizes there, in the unit of size_name.
  double size = 0.0;
  double size_low = 0.0;
  double size_high = 0.0;
  std::string size_name;
  // False where the cases do not determine the size: the interval is wider than from small to
  // medium.
  bool resolved = false;
};

// The direction of a size beyond those that a trial has: "below small" or "beyond large"; else
// empty.
std::string_view BeyondTried(double severity);

// An effect is found if it is named, or is in a class of at most three. Only cases with a single
// effect of the catalogue count.
std::vector<EffectPower> ComputePower(std::span<const CaseOutcome> cases,
                                      std::span<const RigEffect> effects);

}  // namespace howl

#endif  // HOWL_TRIAL_POWER_H_
