// What a diagnosis found: the verdict with its evidence, where the gap lies, and the candidates.
#ifndef HOWL_DIAGNOSIS_VERDICT_DIAGNOSIS_RESULT_H_
#define HOWL_DIAGNOSIS_VERDICT_DIAGNOSIS_RESULT_H_

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/fit/estimated_parameter.h"
#include "diagnosis/fit/moved_parameters.h"
#include "diagnosis/gap/gap_map.h"
#include "diagnosis/records/base_model.h"
#include "diagnosis/verdict/budget.h"
#include "model/effects/effect.h"

namespace howl {

enum class VerdictKind : std::uint8_t { kNone, kEffect, kUnknown };

struct Candidate {
  std::string effect;
  LoopBlock block = LoopBlock::kAcoustics;
  double gain = 0.0;  // of log-likelihood over the base, less half a log(data) a parameter
  double gap_after = 0.0;
  double shrinkage = 0.0;
  double shrinkage_low = 0.0;  // 95 %, over the experiments
  double shrinkage_high = 0.0;
  // Of the largest gain in the catalogue: by the bootstrap if there was one, else roughly by
  // chi-square.
  double p_value = 1.0;
  double probability = 0.0;
  std::vector<EstimatedParameter> parameters;
};

struct Diagnosis {
  VerdictKind kind = VerdictKind::kNone;
  std::string effect;  // empty unless kEffect; "a+b": two at once
  std::vector<std::string> indistinguishable;
  // With the verdict unknown: two effects of the catalogue that together would leave little; empty
  // if there are none.
  std::string together;
  double probability_none = 0.0;
  double probability_unknown = 0.0;
  std::vector<Place> where;
  double gap_before = 0.0;
  double gap_after = 0.0;
  double gap_floor = 0.0;
  // Median shrinkage of the gap by placebo effects with as many parameters as the best candidate
  // (placebo.h); NaN where the best is no transfer function.
  double placebo_shrinkage = std::numeric_limits<double>::quiet_NaN();
  std::vector<GapCell> map;           // before and after the best effect
  std::vector<Candidate> candidates;  // the most probable first
  BaseModel model;                    // the base to which effects were added
  // The gain in log-likelihood by a second mode, less the price of its coefficients, where the
  // records choose the modes (choose_modes.h); NaN where the model states them.
  double second_mode_gain = std::numeric_limits<double>::quiet_NaN();
  // The gain in log-likelihood by own delays, given the best effect or none, where the records
  // choose the delays; NaN where the model states them.
  double own_delays_gain = std::numeric_limits<double>::quiet_NaN();
  double delay_scatter = 0.0;  // of log tau over the experiments, in the best fit
  // The loop's parameters that moved, where the verdict is an effect whose fit has them.
  std::vector<MovedParameter> base_parameters;
  // The gain in log-likelihood by free slack before and after the best effect, in cuts A and B.
  double slack_acoustic_before = 0.0;
  double slack_flame_before = 0.0;
  double slack_acoustic_after = 0.0;
  double slack_flame_after = 0.0;
  // The largest gain of each replicate of the bootstrap, ascending; empty if there was none.
  std::vector<double> bootstrap_gains;
  std::string advice;
  // Of a diagnosis of loops (loop_budget.h): what was added to the base.
  std::optional<Budget> budget;
  bool stopped = false;  // the run was stopped before its end, and the rest is empty
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_VERDICT_DIAGNOSIS_RESULT_H_
