// The plan of a trial: which effects each case has, and how strong they are, balanced over effects
// and sizes, in random order.
#ifndef HOWL_TRIAL_CASE_PLAN_H_
#define HOWL_TRIAL_CASE_PLAN_H_

#include <cstdint>
#include <string>
#include <vector>

#include "trial/outcome.h"

namespace howl {

struct CasePlan {
  std::string name;                  // case001: says nothing
  std::vector<std::string> effects;  // none, one or two
  double severity = 0.0;
  std::uint64_t rig_seed = 0;
};

struct TrialOptions {
  int cases = 0;
  // Identifiers, two joined by "+", or the groups catalogue, outside, none and pairs.
  std::vector<std::string> effects;
  std::vector<double> severities;
  std::uint64_t seed = 0;
};

// Shares of the groups: of the catalogue (and of what is named) 60 %, none 15 %, outside 15 %,
// pairs 10 %, divided by the sum of those asked for. Throws std::invalid_argument at an effect that
// the rig has not.
std::vector<CasePlan> PlanCases(const TrialOptions& options, const std::vector<RigEffect>& effects);

}  // namespace howl

#endif  // HOWL_TRIAL_CASE_PLAN_H_
