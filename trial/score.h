// The score sheet of a blind trial.
#ifndef HOWL_TRIAL_SCORE_H_
#define HOWL_TRIAL_SCORE_H_

#include <map>
#include <span>
#include <string>
#include <vector>

#include "trial/outcome.h"
#include "trial/power.h"
#include "trial/tally.h"

namespace howl {

inline constexpr std::size_t kClassSize = 3;

// True if the effect was named, or is in the class of the named one, if that has at most three
// members.
bool IsNamed(const CaseOutcome& one);
bool IsInClass(const CaseOutcome& one);
bool IsRightBlock(const CaseOutcome& one);

struct Accuracy {
  Tally named;
  Tally in_class;
  Tally block;
};

struct ReliabilityBin {
  double low = 0.0;
  double high = 0.0;
  double mean_probability = 0.0;
  Tally right;
};

// The score of one way to answer. Cases with two effects are left out of all but `pairs`.
struct MethodScore {
  std::string method;
  std::map<double, Accuracy> by_severity;  // one effect of the catalogue
  Accuracy catalogue;                      // the same, all severities
  Accuracy medium_and_large;               // severity of 0.4 and more
  Tally false_alarms;                      // an effect named, or "unknown", where there is none
  Tally accused;                           // an effect named where there is none
  Tally unknown_recall;                    // "unknown" where the effect is outside the catalogue
  Tally unknown_recall_medium_and_large;
  Tally outside_block;                      // the place right, named or not
  Tally false_unknowns;                     // "unknown" where the effect is in the catalogue
  Tally pairs_both_named;                   // of two effects: both are named, and no other
  Tally pairs_one_named;                    // ... one, and no other
  Tally pairs_unknown;                      // ... "unknown"
  double log_score = 0.0;                   // mean of -ln p(truth), p of at least 0.001
  double brier = 0.0;                       // mean of the sum of (p - truth)^2
  std::vector<ReliabilityBin> reliability;  // of the most probable answer, in all cases
  // By what is answered, none, effect or unknown: how often that is all that was withheld.
  std::map<std::string, Tally> by_answer;
  // The answer's shrinkage over the true effect's, where the latter is at least 0.1.
  double median_shrinkage_over_oracle = 0.0;
  int oracle_cases = 0;
};

struct Confusion {
  std::vector<std::string> rows;     // truths
  std::vector<std::string> columns;  // answers
  std::vector<std::vector<int>> count;
};

struct Floor {  // gap of cases without an effect: the distance of the two simulators
  int cases = 0;
  double median_gap = 0.0;
  double largest_gap = 0.0;
  double median_floor = 0.0;  // what sampling alone leaves, as diagnose reports it
};

struct ScoreSheet {
  int cases = 0;
  int failed = 0;
  MethodScore howl;
  std::vector<MethodScore> rivals;  // always none, largest in-sample gain, BIC
  Confusion confusion;
  Floor floor;
  std::vector<EffectPower> power;
  std::map<std::string, Accuracy> by_effect;  // effects of the catalogue, all severities
  std::map<std::string, std::pair<Tally, Tally>> outside;  // "unknown", and the place
};

ScoreSheet Score(std::span<const CaseOutcome> cases, std::span<const RigEffect> effects);

// The same case with the answer of a trivial rival.
CaseOutcome AlwaysNone(const CaseOutcome& one);
CaseOutcome LargestGain(const CaseOutcome& one, std::span<const RigEffect> effects);
CaseOutcome LeastBic(const CaseOutcome& one, std::span<const RigEffect> effects);

}  // namespace howl

#endif  // HOWL_TRIAL_SCORE_H_
