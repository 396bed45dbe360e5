// The diagnosis of loops that records show (record_loop_spec.h): which sources of noise and which
// freedoms the config's loop lacks, one after the other, how much each explains, and what is left.
//
// The verdict names what the samples themselves show (sample_facts.h), and then nothing is added;
// else all that was added, in that order, but finer spectra of noise; `none` where nothing pays. It
// is `unknown` where free errors at the cycle's lines (loop_point.h), of the acoustics or of the
// flame, pay where nothing else does, unless a gain that fluctuates makes such (lines_of_gain.h):
// the best loop then is not the rig's; where more is left of the gap than its floor, which a right
// loop leaves (held_out_score.h), or where that floor is so high that no gap could exceed it; where
// it would name more than two causes (odds.h); where one half of the records speaks against an
// item; and where an effect of the catalogue would have a value that it cannot have, as a share of
// the flame below zero: something else does the same then. The probabilities are those of the base,
// of the best loop without such errors, and of that with them, by the densities of what was left
// out.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_BUDGET_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_BUDGET_H_

#include <limits>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/account/lines_of_gain.h"
#include "diagnosis/loop_budget/forms/odds.h"
#include "diagnosis/loop_budget/trials/loop_trial.h"
#include "diagnosis/verdict/diagnosis_result.h"

namespace howl {

// Free errors of a cut at the cycle's lines: what they gain beside the best loop, or what it loses
// without them.
struct LinesLeft {
  double nats = 0.0;  // of what was left out
  double size = 0.0;  // relative: what the law of the points has (parameter_law.h)
  std::size_t experiments_better = 0;
  LinesOfGain of_gain = {};  // of the flame

  bool AreOfGain() const { return of_gain.missed < kBoundOfGain * of_gain.bound; }
  // What they say against the loop: those of a gain that fluctuates nothing.
  double NatsAgainst() const {
    return AreOfGain() ? -std::numeric_limits<double>::infinity() : nats;
  }
};

struct LoopDiagnosis {
  Diagnosis diagnosis;  // with its budget; candidates and map are empty
  LoopForm base;
  LoopForm best;
  // That it began with and that were added, with which another diagnosis may begin.
  std::vector<std::string> items;
  LinesLeft acoustics;
  LinesLeft flame;
  std::string unknown_because;  // for a reader; empty where the verdict is another
};

LoopDiagnosis DiagnoseLoops(const std::vector<LoopRecord>& records, const LoopForm& base,
                            const LoopBudgetOptions& options);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_LOOP_BUDGET_H_
