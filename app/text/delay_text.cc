#include "app/text/delay_text.h"

#include "app/text/text_table.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

constexpr double kHardlyProbable = 0.05;

std::string PeriodsText(int periods) {
  return std::to_string(periods) + (periods == 1 ? " whole period" : " whole periods");
}

}  // namespace

bool DelayIsOpen(const DelayChoice& choice) {
  return !choice.branches.empty() && !choice.given && !choice.by_consistency;
}

std::string DelayText(const DelayChoice& choice) {
  if (choice.branches.empty() || choice.given) return "";
  if (choice.by_consistency) {
    return "the delay exceeds the shortest by " + PeriodsText(choice.branch) + " (probability " +
           Fixed(choice.branches.front().probability, 2) + ")\n";
  }
  std::string odds;
  for (const DelayBranch& branch : choice.branches) {
    if (branch.probability < kHardlyProbable && branch.branch != choice.branch) continue;
    odds += (odds.empty() ? "" : ", ") + std::to_string(branch.branch) + ": " +
            Fixed(kPerCent * branch.probability, 0) + " %";
  }
  return Wrapped("the data cannot tell by how many whole periods the delay exceeds the shortest (" +
                     odds + "): " + std::to_string(choice.branch) +
                     " is taken; `analysis: {delay_branch: K}` states another",
                 2) +
         "\n";
}

}  // namespace howl
